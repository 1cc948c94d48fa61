// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Work units.
#include "database/record_checks.hpp"
#include "database/sql_store.hpp"
#include "database/unit_state.hpp"

namespace eigengrasp {

std::size_t SqlStore::add_units(const std::vector<UnitKey>& keys) {
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  std::size_t added = 0;
  for (const UnitKey& key : keys) {
    const Slot slot = slot_of(key);
    // Looked for first, so that what is there costs no number of the sequence.
    if (count("SELECT count(*) FROM work_unit WHERE scaled_model_id = $1 AND hand_id = $2",
              {slot.scaled_model, slot.hand}) > 0)
      continue;
    added += affects(
        "INSERT INTO work_unit (scaled_model_id, hand_id, work_unit_state, work_unit_reason, "
        "work_unit_worker, "
        "work_unit_lease, work_unit_seconds) VALUES ($1, $2, 'waiting', '', '', 0, 0) "
        "ON CONFLICT (scaled_model_id, hand_id) DO NOTHING RETURNING work_unit_id",
        {slot.scaled_model, slot.hand});
  }
  transaction.commit();
  return added;
}

std::vector<StoredUnit> SqlStore::units_where(const std::string& condition) {
  std::vector<StoredUnit> units;
  db_->run(
      "SELECT o.original_model_name, s.scaled_model_scale, h.hand_name, w.work_unit_state, "
      "w.work_unit_reason, "
      "w.work_unit_worker, w.work_unit_lease, w.work_unit_seconds FROM work_unit w "
      "JOIN scaled_model s ON s.scaled_model_id = w.scaled_model_id "
      "JOIN original_model o ON o.original_model_id = s.original_model_id "
      "JOIN hand h ON h.hand_id = w.hand_id " +
          condition + " ORDER BY w.work_unit_id",
      {}, [&](const SqlRow& row) {
        units.push_back({{row.string(0), row.number(1), row.string(2)},
                         parse_unit_state(row.text(3), place()),
                         row.string(4),
                         row.string(5),
                         row.number(6),
                         row.number(7)});
      });
  return units;
}

std::vector<StoredUnit> SqlStore::units() {
  const std::lock_guard lock(mutex_);
  return units_where("");
}

std::vector<StoredUnit> SqlStore::claimed_units() {
  const std::lock_guard lock(mutex_);
  // The first condition is that of the index of open units.
  return units_where("WHERE w.work_unit_state IN ('waiting', 'claimed') AND w.work_unit_state = 'claimed'");
}

/// Within a transaction. SQLite locks the file for the statement, PostgreSQL the row, passing over what
/// others are taking.
std::optional<SqlStore::Slot> SqlStore::claim_first(const std::string& worker, double lease_seconds) {
  // A claim that a power cut takes is a unit that waits again.
  if (!db_->dialect().light_commit.empty()) db_->script(db_->dialect().light_commit);
  std::optional<Slot> slot;
  db_->run(
      sql("UPDATE work_unit SET work_unit_state = 'claimed', work_unit_worker = $1, "
          "work_unit_lease = @clock + CAST($2 AS DOUBLE PRECISION) WHERE work_unit_id = (SELECT work_unit_id "
          "FROM work_unit WHERE work_unit_state IN ('waiting', 'claimed') AND "
          "(work_unit_state = 'waiting' OR work_unit_lease < @clock) ORDER BY work_unit_id LIMIT 1" +
          db_->dialect().skip_locked + ") RETURNING scaled_model_id, hand_id"),
      {worker, lease_seconds}, [&](const SqlRow& row) {
        slot = Slot{row.integer(0), row.integer(1)};
      });
  return slot;
}

UnitKey SqlStore::key_of(Slot slot) {
  UnitKey key;
  db_->run(
      "SELECT o.original_model_name, s.scaled_model_scale, h.hand_name FROM scaled_model s "
      "JOIN original_model o ON o.original_model_id = s.original_model_id, hand h "
      "WHERE s.scaled_model_id = $1 AND h.hand_id = $2",
      {slot.scaled_model, slot.hand}, [&](const SqlRow& row) {
        key = UnitKey{row.string(0), row.number(1), row.string(2)};
      });
  return key;
}

std::optional<UnitKey> SqlStore::claim_unit(const std::string& worker, double lease_seconds) {
  require_claim(worker, lease_seconds);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  std::optional<UnitKey> key;
  if (const std::optional<Slot> slot = claim_first(worker, lease_seconds)) key = key_of(*slot);
  transaction.commit();
  return key;
}

std::vector<UnitKey> SqlStore::claim_object(const std::string& worker, double lease_seconds) {
  require_claim(worker, lease_seconds);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  std::map<std::int64_t, Slot> others;  // by number of the unit
  std::vector<UnitKey> keys;
  if (const std::optional<Slot> first = claim_first(worker, lease_seconds)) {
    keys.push_back(key_of(*first));
    db_->run(
        sql("UPDATE work_unit SET work_unit_state = 'claimed', work_unit_worker = $1, "
            "work_unit_lease = @clock + CAST($2 AS DOUBLE PRECISION) WHERE work_unit_id IN (SELECT "
            "work_unit_id FROM work_unit WHERE scaled_model_id IN (SELECT scaled_model_id FROM scaled_model "
            "WHERE original_model_id = $3) AND work_unit_state IN ('waiting', 'claimed') AND "
            "(work_unit_state = 'waiting' OR work_unit_lease < @clock) ORDER BY work_unit_id" +
            db_->dialect().skip_locked + ") RETURNING scaled_model_id, hand_id, work_unit_id"),
        {worker, lease_seconds, model_id(keys.front().object)}, [&](const SqlRow& row) {
          others[row.integer(2)] = Slot{row.integer(0), row.integer(1)};
        });
  }
  for (const auto& [number, slot] : others) keys.push_back(key_of(slot));
  transaction.commit();
  return keys;
}

bool SqlStore::renew_lease(const UnitKey& key, const std::string& worker, double lease_seconds) {
  require_claim(worker, lease_seconds);
  const std::lock_guard lock(mutex_);
  const Slot slot = slot_of(key);
  return affects(
      "UPDATE work_unit SET work_unit_lease = @clock + CAST($1 AS DOUBLE PRECISION) "
      "WHERE scaled_model_id = $2 AND hand_id = $3 AND work_unit_worker = $4 AND work_unit_state = 'claimed' "
      "RETURNING work_unit_id",
      {lease_seconds, slot.scaled_model, slot.hand, worker});
}

bool SqlStore::release_unit(const UnitKey& key, const std::string& worker) {
  const std::lock_guard lock(mutex_);
  const Slot slot = slot_of(key);
  return affects(
      "UPDATE work_unit SET work_unit_state = 'waiting', work_unit_worker = '', work_unit_lease = 0 "
      "WHERE scaled_model_id = $1 AND hand_id = $2 AND work_unit_worker = $3 AND work_unit_state = 'claimed' "
      "RETURNING work_unit_id",
      {slot.scaled_model, slot.hand, worker});
}

std::size_t SqlStore::reopen_failed_units() {
  const std::lock_guard lock(mutex_);
  std::size_t n = 0;
  db_->run(
      "UPDATE work_unit SET work_unit_state = 'waiting', work_unit_reason = '', work_unit_worker = '', "
      "work_unit_seconds = 0 WHERE work_unit_state = 'failed' RETURNING work_unit_id",
      {}, [&](const SqlRow&) { ++n; });
  return n;
}

/// @returns false where the unit has an outcome already.
bool SqlStore::store_outcome(const UnitResult& r, Slot slot) {
  return affects(
      "INSERT INTO work_unit (scaled_model_id, hand_id, work_unit_state, work_unit_reason, work_unit_worker, "
      "work_unit_lease, work_unit_seconds) VALUES ($1, $2, $3, $4, $5, 0, $6) "
      "ON CONFLICT (scaled_model_id, hand_id) DO UPDATE SET work_unit_state = excluded.work_unit_state, "
      "work_unit_reason = excluded.work_unit_reason, work_unit_worker = excluded.work_unit_worker, "
      "work_unit_lease = 0, work_unit_seconds = excluded.work_unit_seconds "
      "WHERE work_unit.work_unit_state IN ('waiting', 'claimed') RETURNING work_unit_id",
      {slot.scaled_model, slot.hand, to_string(r.state), r.reason, r.worker, r.seconds});
}

std::vector<bool> SqlStore::finish_units(const std::vector<UnitResult>& results) {
  for (const UnitResult& r : results) require_sound(r);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  std::vector<bool> stored;
  std::vector<GraspRow> rows;
  for (const UnitResult& r : results) {
    const Slot slot = slot_of(r.key);
    stored.push_back(store_outcome(r, slot));
    if (stored.back()) append_rows(r.key, slot, r.grasps, rows);
  }
  db_->insert_grasps(rows);
  transaction.commit();
  return stored;
}

}  // namespace eigengrasp
