// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

namespace eigengrasp {

/// Version 1 of the schema: the tables of the Columbia Grasp Database. What its clients see is in mm and has
/// its extra first element (5 for joints in the hand's degrees of freedom, 0 for a complete position); what
/// we need beside it, in metres, stands in further columns. A grasp that a client saved has no grasp_exact.
inline constexpr const char* kPostgresSchema1 = R"sql(
CREATE TABLE original_model (
  original_model_id SERIAL PRIMARY KEY,
  original_model_name TEXT NOT NULL UNIQUE,
  original_model_geometry_path TEXT NOT NULL,
  original_model_thumbnail_path TEXT NOT NULL,
  original_model_tags TEXT[] NOT NULL,
  original_model_content_hash TEXT NOT NULL,
  original_model_rescale DOUBLE PRECISION NOT NULL,
  original_model_radius DOUBLE PRECISION NOT NULL,
  original_model_grasping_rescale DOUBLE PRECISION GENERATED ALWAYS AS (1000 * original_model_rescale) STORED,
  original_model_approximate_radius DOUBLE PRECISION
    GENERATED ALWAYS AS (1000 * original_model_radius) STORED);
CREATE TABLE scaled_model (
  scaled_model_id SERIAL PRIMARY KEY,
  scaled_model_name TEXT NOT NULL UNIQUE,
  scaled_model_scale DOUBLE PRECISION NOT NULL,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  UNIQUE (original_model_id, scaled_model_scale));
CREATE TABLE hand (
  hand_id SERIAL PRIMARY KEY,
  hand_name TEXT NOT NULL UNIQUE,
  hand_joints TEXT NOT NULL,
  hand_dofs TEXT NOT NULL,
  hand_links TEXT NOT NULL);
CREATE TABLE grasp_source (
  grasp_source_id SERIAL PRIMARY KEY,
  grasp_source_name TEXT NOT NULL UNIQUE,
  grasp_source_description TEXT NOT NULL);
CREATE TABLE grasp (
  grasp_id SERIAL PRIMARY KEY,
  scaled_model_id INTEGER NOT NULL REFERENCES scaled_model,
  hand_id INTEGER NOT NULL REFERENCES hand,
  grasp_source_id INTEGER NOT NULL REFERENCES grasp_source,
  grasp_rank INTEGER NOT NULL,
  grasp_pregrasp_joints DOUBLE PRECISION[] NOT NULL,
  grasp_pregrasp_position DOUBLE PRECISION[] NOT NULL,
  grasp_grasp_joints DOUBLE PRECISION[] NOT NULL,
  grasp_grasp_position DOUBLE PRECISION[] NOT NULL,
  grasp_contacts DOUBLE PRECISION[] NOT NULL,
  grasp_energy DOUBLE PRECISION NOT NULL,
  grasp_epsilon_quality DOUBLE PRECISION NOT NULL,
  grasp_volume_quality DOUBLE PRECISION NOT NULL,
  grasp_exact BYTEA,
  UNIQUE (scaled_model_id, hand_id, grasp_rank)) WITH (toast_tuple_target = 8160);
ALTER TABLE grasp ALTER grasp_exact SET STORAGE EXTERNAL;
CREATE TABLE work_unit (
  work_unit_id SERIAL PRIMARY KEY,
  scaled_model_id INTEGER NOT NULL REFERENCES scaled_model,
  hand_id INTEGER NOT NULL REFERENCES hand,
  work_unit_state TEXT NOT NULL CHECK (work_unit_state IN ('waiting', 'claimed', 'done', 'failed')),
  work_unit_reason TEXT NOT NULL,
  work_unit_worker TEXT NOT NULL,
  work_unit_lease DOUBLE PRECISION NOT NULL,
  work_unit_seconds DOUBLE PRECISION NOT NULL,
  UNIQUE (scaled_model_id, hand_id));
CREATE INDEX work_unit_open ON work_unit (work_unit_id) WHERE work_unit_state IN ('waiting', 'claimed');
CREATE TABLE distance_function (
  distance_function_id SERIAL PRIMARY KEY,
  distance_function_name TEXT NOT NULL UNIQUE,
  distance_function_description TEXT NOT NULL DEFAULT '');
CREATE TABLE neighbor (
  neighbor_id SERIAL PRIMARY KEY,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  neighbor_original_model_id INTEGER NOT NULL REFERENCES original_model,
  distance_function_id INTEGER NOT NULL REFERENCES distance_function,
  neighbor_distance DOUBLE PRECISION NOT NULL,
  UNIQUE (original_model_id, distance_function_id, neighbor_original_model_id));
CREATE TABLE alignment_method (
  alignment_method_id SERIAL PRIMARY KEY,
  alignment_method_name TEXT NOT NULL UNIQUE,
  alignment_method_description TEXT NOT NULL DEFAULT '');
CREATE TABLE alignment (
  alignment_id SERIAL PRIMARY KEY,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  alignment_original_model_id INTEGER NOT NULL REFERENCES original_model,
  alignment_method_id INTEGER NOT NULL REFERENCES alignment_method,
  alignment_matrix DOUBLE PRECISION[] NOT NULL,
  UNIQUE (original_model_id, alignment_original_model_id, alignment_method_id));

-- The rank of the next grasp of a scaled model and hand; others wait until the transaction ends.
CREATE FUNCTION next_grasp_rank(scaled_model INTEGER, hand INTEGER) RETURNS INTEGER LANGUAGE plpgsql AS $$
BEGIN
  PERFORM pg_advisory_xact_lock(scaled_model, hand);
  RETURN (SELECT coalesce(max(g.grasp_rank) + 1, 0) FROM grasp g
          WHERE g.scaled_model_id = scaled_model AND g.hand_id = hand);
END $$;
)sql";

/// What GraspIt!'s database client calls.
inline constexpr const char* kPostgresClientFunctions1 = R"sql(
CREATE FUNCTION get_models()
RETURNS TABLE (model_name TEXT, thumbnail_path TEXT, geometry_path TEXT, scale DOUBLE PRECISION, tags TEXT[],
               grasping_rescale DOUBLE PRECISION) LANGUAGE sql STABLE AS $$
  SELECT s.scaled_model_name, o.original_model_thumbnail_path, o.original_model_geometry_path,
         s.scaled_model_scale, o.original_model_tags, o.original_model_grasping_rescale
  FROM scaled_model s JOIN original_model o USING (original_model_id) ORDER BY s.scaled_model_id $$;

CREATE FUNCTION get_grasps(TEXT, TEXT)
RETURNS TABLE (grasp_id INTEGER, grasp_pregrasp_joints DOUBLE PRECISION[],
               grasp_pregrasp_position DOUBLE PRECISION[], grasp_grasp_joints DOUBLE PRECISION[],
               grasp_grasp_position DOUBLE PRECISION[], grasp_contacts DOUBLE PRECISION[],
               grasp_energy DOUBLE PRECISION, grasp_epsilon_quality DOUBLE PRECISION,
               grasp_volume_quality DOUBLE PRECISION, grasp_source_name TEXT) LANGUAGE sql STABLE AS $$
  SELECT g.grasp_id, g.grasp_pregrasp_joints, g.grasp_pregrasp_position, g.grasp_grasp_joints,
         g.grasp_grasp_position, g.grasp_contacts, g.grasp_energy, g.grasp_epsilon_quality,
         g.grasp_volume_quality, c.grasp_source_name
  FROM scaled_model s JOIN grasp g USING (scaled_model_id) JOIN hand h USING (hand_id)
       JOIN grasp_source c USING (grasp_source_id)
  WHERE s.scaled_model_name = $1 AND h.hand_name = $2 ORDER BY g.grasp_rank $$;

CREATE FUNCTION save_grasp(model_name TEXT, of_hand TEXT, pregrasp_joints DOUBLE PRECISION[],
                           pregrasp_position DOUBLE PRECISION[], grasp_joints DOUBLE PRECISION[],
                           grasp_position DOUBLE PRECISION[], contacts DOUBLE PRECISION[],
                           energy DOUBLE PRECISION, epsilon DOUBLE PRECISION, volume DOUBLE PRECISION,
                           source TEXT) RETURNS INTEGER LANGUAGE plpgsql AS $$
DECLARE
  model INTEGER := (SELECT scaled_model_id FROM scaled_model WHERE scaled_model_name = model_name);
  by_hand INTEGER := (SELECT hand_id FROM hand WHERE hand_name = of_hand);
  made INTEGER;
BEGIN
  IF model IS NULL THEN RAISE EXCEPTION 'there is no scaled model ''%''', model_name; END IF;
  IF by_hand IS NULL THEN RAISE EXCEPTION 'there is no hand ''%''', of_hand; END IF;
  IF cardinality(pregrasp_position) <> 8 OR cardinality(grasp_position) <> 8 THEN
    RAISE EXCEPTION 'a position has 8 numbers: 0, x, y, z [mm], then the quaternion w, x, y, z';
  END IF;
  INSERT INTO grasp_source (grasp_source_name, grasp_source_description)
    VALUES (source, 'saved by a client') ON CONFLICT DO NOTHING;
  INSERT INTO grasp (scaled_model_id, hand_id, grasp_source_id, grasp_rank, grasp_pregrasp_joints,
                     grasp_pregrasp_position, grasp_grasp_joints, grasp_grasp_position, grasp_contacts,
                     grasp_energy, grasp_epsilon_quality, grasp_volume_quality)
    VALUES (model, by_hand, (SELECT grasp_source_id FROM grasp_source WHERE grasp_source_name = source),
            next_grasp_rank(model, by_hand), pregrasp_joints, pregrasp_position, grasp_joints, grasp_position,
            contacts, energy, epsilon, volume)
    RETURNING grasp_id INTO made;
  RETURN made;
END $$;

-- The neighbours of an object at the scale that was asked for.
CREATE FUNCTION get_saved_neighbors(TEXT, TEXT, INTEGER)
RETURNS TABLE (model_name TEXT, thumbnail_path TEXT, geometry_path TEXT, scale DOUBLE PRECISION, tags TEXT[],
               grasping_rescale DOUBLE PRECISION, distance DOUBLE PRECISION) LANGUAGE sql STABLE AS $$
  SELECT t.scaled_model_name, o.original_model_thumbnail_path, o.original_model_geometry_path,
         t.scaled_model_scale, o.original_model_tags, o.original_model_grasping_rescale, n.neighbor_distance
  FROM scaled_model s JOIN neighbor n USING (original_model_id)
       JOIN distance_function f USING (distance_function_id)
       JOIN original_model o ON o.original_model_id = n.neighbor_original_model_id
       JOIN scaled_model t ON t.original_model_id = o.original_model_id
                          AND t.scaled_model_scale = s.scaled_model_scale
  WHERE s.scaled_model_name = $1 AND f.distance_function_name = $2
  ORDER BY n.neighbor_distance, n.neighbor_id LIMIT $3 $$;

-- Row by row, from the first model's frame to the second's, translation in mm.
CREATE FUNCTION get_alignment(TEXT, TEXT, TEXT) RETURNS DOUBLE PRECISION[] LANGUAGE sql STABLE AS $$
  SELECT ARRAY(SELECT CASE WHEN i IN (4, 8, 12) THEN 1000 * m ELSE m END
               FROM unnest(a.alignment_matrix) WITH ORDINALITY AS e(m, i) ORDER BY i)
  FROM alignment a JOIN alignment_method m USING (alignment_method_id)
       JOIN scaled_model s ON s.original_model_id = a.original_model_id
       JOIN scaled_model t ON t.original_model_id = a.alignment_original_model_id
  WHERE s.scaled_model_name = $1 AND t.scaled_model_name = $2 AND m.alignment_method_name = $3 $$;

CREATE FUNCTION get_distance_function_names() RETURNS TABLE (distance_function_name TEXT) LANGUAGE sql STABLE
AS $$ SELECT f.distance_function_name FROM distance_function f ORDER BY f.distance_function_id $$;
CREATE FUNCTION get_alignment_method_names() RETURNS TABLE (alignment_method_name TEXT) LANGUAGE sql STABLE
AS $$ SELECT m.alignment_method_name FROM alignment_method m ORDER BY m.alignment_method_id $$;
CREATE FUNCTION get_grasp_type_names() RETURNS TABLE (grasp_type_name TEXT) LANGUAGE sql STABLE
AS $$ SELECT c.grasp_source_name FROM grasp_source c ORDER BY c.grasp_source_id $$;
)sql";

/// Version 2: descriptors of objects' shapes. A ball is its centre and radius.
inline constexpr const char* kPostgresSchema2 = R"sql(
CREATE TABLE descriptor (
  descriptor_id SERIAL PRIMARY KEY,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  descriptor_function TEXT NOT NULL,
  descriptor_route TEXT NOT NULL,
  descriptor_ball DOUBLE PRECISION[] NOT NULL,
  descriptor_invariants DOUBLE PRECISION[] NOT NULL,
  UNIQUE (original_model_id, descriptor_function));
)sql";

}  // namespace eigengrasp
