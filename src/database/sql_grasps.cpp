// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Grasps.
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

}  // namespace eigengrasp
