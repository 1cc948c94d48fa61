// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Grasps, neighbours and alignments.
#include <fmt/format.h>

#include "database/cgdb_grasp.hpp"
#include "database/grasp_blob.hpp"
#include "database/number_list.hpp"
#include "database/record_checks.hpp"
#include "database/sql_store.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

void SqlStore::append_rows(const UnitKey& key, Slot slot, const std::vector<StoredGrasp>& grasps,
                           std::vector<GraspRow>& rows) {
  if (grasps.empty()) return;
  const StoredHand& hand = known_hand(key.hand).hand;
  std::int64_t rank = count(db_->dialect().next_rank, {slot.scaled_model, slot.hand});
  for (const StoredGrasp& g : grasps)
    rows.push_back(
        {slot.scaled_model, slot.hand, source_id(g.source), rank++, &g.grasp, encode_grasp(g.grasp, hand)});
}

void SqlStore::add_grasps(const UnitKey& key, const std::vector<StoredGrasp>& grasps) {
  require_sound(key, grasps);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  std::vector<GraspRow> rows;
  append_rows(key, slot_of(key), grasps, rows);
  db_->insert_grasps(rows);
  transaction.commit();
}

/// Of a grasp that a client of the Columbia Grasp Database saved.
StoredGrasp SqlStore::read_client_grasp(std::int64_t id, const std::string& where) {
  StoredGrasp stored;
  const std::string query = sql(
      "SELECT @numbers_out(grasp_pregrasp_joints), @numbers_out(grasp_pregrasp_position), "
      "@numbers_out(grasp_grasp_joints), @numbers_out(grasp_grasp_position), @numbers_out(grasp_contacts), "
      "grasp_energy, grasp_epsilon_quality, grasp_volume_quality FROM grasp WHERE grasp_id = $1");
  db_->run(query, {id}, [&](const SqlRow& row) {
    CgdbGrasp columns;
    int i = 0;
    for (auto* numbers : {&columns.pregrasp_joints, &columns.pregrasp_position, &columns.grasp_joints,
                          &columns.grasp_position, &columns.contacts})
      *numbers = parse_numbers(row.text(i++), where);
    Grasp& g = stored.grasp = from_cgdb(columns, where);
    g.energy = row.number(5);
    g.epsilon = row.number(6);
    g.volume = row.number(7);
    g.form_closure = g.epsilon > 0.0;
  });
  return stored;
}

std::vector<StoredGrasp> SqlStore::grasps(const std::string& model, const std::string& hand) {
  const std::lock_guard lock(mutex_);
  const KnownHand& known = known_hand(hand);
  std::vector<StoredGrasp> grasps;
  std::vector<std::size_t> of_clients;
  std::vector<std::int64_t> source_ids;
  db_->run(
      "SELECT g.grasp_id, s.scaled_model_scale, g.grasp_source_id, g.grasp_exact FROM scaled_model s "
      "JOIN grasp g ON g.scaled_model_id = s.scaled_model_id WHERE s.original_model_id = $1 AND g.hand_id = "
      "$2 "
      "ORDER BY s.scaled_model_scale, g.grasp_rank",
      {model_id(model), known.id}, [&](const SqlRow& row) {
        StoredGrasp g;
        g.id = row.integer(0);
        if (row.is_null(3)) {
          of_clients.push_back(grasps.size());
        } else {
          g.grasp = decode_grasp(row.text(3), known.hand, place());
        }
        g.grasp.object_scale = row.number(1);
        source_ids.push_back(row.integer(2));
        grasps.push_back(std::move(g));
      });
  for (const std::size_t i : of_clients) {
    StoredGrasp g = read_client_grasp(grasps[i].id, fmt::format("{}: grasp {}", place(), grasps[i].id));
    g.id = grasps[i].id;
    g.grasp.object_scale = grasps[i].grasp.object_scale;
    grasps[i] = std::move(g);
  }
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    grasps[i].source = source_name(source_ids[i]);
    grasps[i].grasp.object = model;
    grasps[i].grasp.hand = hand;
  }
  return grasps;
}

/// The id of a distance function or an alignment method, which is made where it is missing.
std::int64_t SqlStore::id_of_method(const std::string& table, const std::string& name) {
  const std::string find = fmt::format("SELECT {0}_id FROM {0} WHERE {0}_name = $1", table);
  if (const std::int64_t id = count(find, {name})) return id;
  db_->run(fmt::format("INSERT INTO {0} ({0}_name) VALUES ($1) ON CONFLICT ({0}_name) DO NOTHING", table),
           {name});
  return count(find, {name});
}

void SqlStore::set_neighbors(const std::vector<StoredNeighbor>& neighbors) {
  for (const StoredNeighbor& n : neighbors) require_sound(n);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  for (const StoredNeighbor& n : neighbors)
    db_->run(
        "INSERT INTO neighbor (original_model_id, neighbor_original_model_id, distance_function_id, "
        "neighbor_distance) VALUES ($1, $2, $3, $4) ON CONFLICT (original_model_id, distance_function_id, "
        "neighbor_original_model_id) DO UPDATE SET neighbor_distance = excluded.neighbor_distance",
        {model_id(n.model), model_id(n.neighbor), id_of_method("distance_function", n.distance_function),
         n.distance});
  transaction.commit();
}

std::vector<StoredNeighbor> SqlStore::neighbors() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredNeighbor> neighbors;
  db_->run(
      "SELECT a.original_model_name, b.original_model_name, f.distance_function_name, n.neighbor_distance "
      "FROM neighbor n JOIN original_model a ON a.original_model_id = n.original_model_id "
      "JOIN original_model b ON b.original_model_id = n.neighbor_original_model_id "
      "JOIN distance_function f ON f.distance_function_id = n.distance_function_id ORDER BY n.neighbor_id",
      {}, [&](const SqlRow& row) {
        neighbors.push_back({row.string(0), row.string(1), row.string(2), row.number(3)});
      });
  return neighbors;
}

void SqlStore::set_alignments(const std::vector<StoredAlignment>& alignments) {
  for (const StoredAlignment& a : alignments) require_sound(a);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  for (const StoredAlignment& a : alignments) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = a.X_target_model;
    db_->run(
        sql("INSERT INTO alignment (original_model_id, alignment_original_model_id, alignment_method_id, "
            "alignment_matrix) VALUES ($1, $2, $3, @numbers_in($4)) ON CONFLICT (original_model_id, "
            "alignment_original_model_id, alignment_method_id) DO UPDATE SET "
            "alignment_matrix = excluded.alignment_matrix"),
        {model_id(a.model), model_id(a.target), id_of_method("alignment_method", a.method),
         format_numbers({rows.data(), 16})});
  }
  transaction.commit();
}

std::vector<StoredAlignment> SqlStore::alignments() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredAlignment> alignments;
  db_->run(
      sql("SELECT a.original_model_name, b.original_model_name, m.alignment_method_name, "
          "@numbers_out(x.alignment_matrix) "
          "FROM alignment x JOIN original_model a ON a.original_model_id = x.original_model_id "
          "JOIN original_model b ON b.original_model_id = x.alignment_original_model_id "
          "JOIN alignment_method m ON m.alignment_method_id = x.alignment_method_id ORDER BY x.alignment_id"),
      {}, [&](const SqlRow& row) {
        const auto numbers = parse_numbers(row.text(3), place());
        StoredAlignment& a = alignments.emplace_back();
        a.model = row.string(0);
        a.target = row.string(1);
        a.method = row.string(2);
        if (numbers.size() == 16)
          a.X_target_model = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
      });
  return alignments;
}

}  // namespace eigengrasp
