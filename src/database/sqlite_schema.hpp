// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

namespace eigengrasp {

/// Version 1 of the schema. The tables and columns have the names of the Columbia Grasp Database; lengths are
/// metres, but for columns that say mm.
inline constexpr const char* kSqliteSchema1 = R"sql(
CREATE TABLE original_model (
  original_model_id INTEGER PRIMARY KEY,
  original_model_name TEXT NOT NULL UNIQUE,
  original_model_geometry_path TEXT NOT NULL,
  original_model_thumbnail_path TEXT NOT NULL,
  original_model_tags TEXT NOT NULL,
  original_model_content_hash TEXT NOT NULL,
  original_model_rescale REAL NOT NULL,
  original_model_radius REAL NOT NULL);
CREATE TABLE scaled_model (
  scaled_model_id INTEGER PRIMARY KEY,
  scaled_model_name TEXT NOT NULL UNIQUE,
  scaled_model_scale REAL NOT NULL,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  UNIQUE (original_model_id, scaled_model_scale));
CREATE TABLE hand (
  hand_id INTEGER PRIMARY KEY,
  hand_name TEXT NOT NULL UNIQUE,
  hand_joints TEXT NOT NULL,
  hand_dofs TEXT NOT NULL,
  hand_links TEXT NOT NULL);
CREATE TABLE grasp_source (
  grasp_source_id INTEGER PRIMARY KEY,
  grasp_source_name TEXT NOT NULL UNIQUE,
  grasp_source_description TEXT NOT NULL);
CREATE TABLE grasp (
  grasp_id INTEGER PRIMARY KEY,
  scaled_model_id INTEGER NOT NULL REFERENCES scaled_model,
  hand_id INTEGER NOT NULL REFERENCES hand,
  grasp_source_id INTEGER NOT NULL REFERENCES grasp_source,
  grasp_rank INTEGER NOT NULL,
  grasp_energy REAL NOT NULL,
  grasp_epsilon_quality REAL NOT NULL,
  grasp_volume_quality REAL NOT NULL,
  grasp_exact BLOB NOT NULL,
  UNIQUE (scaled_model_id, hand_id, grasp_rank));
CREATE TABLE work_unit (
  work_unit_id INTEGER PRIMARY KEY,
  scaled_model_id INTEGER NOT NULL REFERENCES scaled_model,
  hand_id INTEGER NOT NULL REFERENCES hand,
  work_unit_state TEXT NOT NULL CHECK (work_unit_state IN ('waiting', 'claimed', 'done', 'failed')),
  work_unit_reason TEXT NOT NULL,
  work_unit_worker TEXT NOT NULL,
  work_unit_lease REAL NOT NULL,
  work_unit_seconds REAL NOT NULL,
  UNIQUE (scaled_model_id, hand_id));
CREATE INDEX work_unit_open ON work_unit (work_unit_id) WHERE work_unit_state IN ('waiting', 'claimed');
CREATE TABLE distance_function (
  distance_function_id INTEGER PRIMARY KEY,
  distance_function_name TEXT NOT NULL UNIQUE,
  distance_function_description TEXT NOT NULL DEFAULT '');
CREATE TABLE neighbor (
  neighbor_id INTEGER PRIMARY KEY,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  neighbor_original_model_id INTEGER NOT NULL REFERENCES original_model,
  distance_function_id INTEGER NOT NULL REFERENCES distance_function,
  neighbor_distance REAL NOT NULL,
  UNIQUE (original_model_id, distance_function_id, neighbor_original_model_id));
CREATE TABLE alignment_method (
  alignment_method_id INTEGER PRIMARY KEY,
  alignment_method_name TEXT NOT NULL UNIQUE,
  alignment_method_description TEXT NOT NULL DEFAULT '');
CREATE TABLE alignment (
  alignment_id INTEGER PRIMARY KEY,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  alignment_original_model_id INTEGER NOT NULL REFERENCES original_model,
  alignment_method_id INTEGER NOT NULL REFERENCES alignment_method,
  alignment_matrix TEXT NOT NULL,
  UNIQUE (original_model_id, alignment_original_model_id, alignment_method_id));
)sql";

/// Version 2: descriptors of objects' shapes. A ball is its centre and radius.
inline constexpr const char* kSqliteSchema2 = R"sql(
CREATE TABLE descriptor (
  descriptor_id INTEGER PRIMARY KEY,
  original_model_id INTEGER NOT NULL REFERENCES original_model,
  descriptor_function TEXT NOT NULL,
  descriptor_route TEXT NOT NULL,
  descriptor_ball TEXT NOT NULL,
  descriptor_invariants TEXT NOT NULL,
  UNIQUE (original_model_id, descriptor_function));
)sql";

}  // namespace eigengrasp
