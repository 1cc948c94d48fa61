// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Units and grasps of a text store: a file for each object at a scale with a hand, which holds the state of
// its unit and the grasps, so that both change together.
#include <fmt/format.h>

#include <chrono>

#include "database/record_checks.hpp"
#include "database/record_json.hpp"
#include "database/text_store.hpp"
#include "database/unit_state.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::int64_t kIdsOfSlot = 1000000;

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// A name as a file's: letters, digits, - and _ stay, other bytes become %XX; a point inside stays, too.
std::string file_name(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || (c == '.' && !out.empty());
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

StoredUnit waiting_unit(const UnitKey& key) {
  StoredUnit unit;
  unit.key = key;
  return unit;
}

std::vector<std::string> lines_of(const std::vector<StoredGrasp>& grasps) {
  std::vector<std::string> lines;
  for (const StoredGrasp& g : grasps) lines.push_back(to_line(g).dump());
  return lines;
}

}  // namespace

fs::path TextStore::slot_path(const UnitKey& key) const {
  return folder_ / "grasps" / file_name(key.object) /
         fmt::format("{}@{}.jsonl", file_name(key.hand), key.scale);
}

std::string TextStore::slot_text(const Slot& slot, const std::vector<std::string>& records) const {
  const StoredUnit& u = slot.unit;
  Json head = {{"object", u.key.object}, {"scale", u.key.scale}, {"hand", u.key.hand}, {"file", slot.number}};
  if (slot.unit_number >= 0)
    head["unit"] = {{"number", slot.unit_number}, {"state", to_string(u.state)},  {"reason", u.reason},
                    {"worker", u.worker},         {"lease_until", u.lease_until}, {"seconds", u.seconds}};
  return format_lines("grasps", {head, records});
}

void TextStore::read_slot(const fs::path& file) {
  const Json head = read_head(file, "grasps");
  Slot slot;
  try {
    StoredUnit& u = slot.unit;
    head.at("object").get_to(u.key.object);
    head.at("scale").get_to(u.key.scale);
    head.at("hand").get_to(u.key.hand);
    head.at("file").get_to(slot.number);
    head.at("records").get_to(slot.n_grasps);
    if (const auto unit = head.find("unit"); unit != head.end()) {
      unit->at("number").get_to(slot.unit_number);
      u.state = parse_unit_state(unit->at("state").get<std::string>(), file.string());
      unit->at("reason").get_to(u.reason);
      unit->at("worker").get_to(u.worker);
      unit->at("lease_until").get_to(u.lease_until);
      unit->at("seconds").get_to(u.seconds);
    }
  } catch (const nlohmann::json::exception&) {
    fail_at(file, 1, "the head is damaged; expected object, scale, hand, file and unit");
  }
  if (slot_path(slot.unit.key) != file)
    fail_at(file, 1, "says that it is {}, which belongs into {}", describe(slot.unit.key),
            slot_path(slot.unit.key).string());
  keep(slot);
}

/// Takes what is on disk over into memory.
void TextStore::keep(const Slot& slot) {
  slots_[slot.unit.key] = slot;
  next_slot_ = std::max(next_slot_, slot.number + 1);
  if (slot.unit_number < 0) return;
  order_[slot.unit_number] = slot.unit.key;
  const bool is_open = slot.unit.state == UnitState::waiting || slot.unit.state == UnitState::claimed;
  if (is_open) {
    open_.insert(slot.unit_number);
  } else {
    open_.erase(slot.unit_number);
  }
}

TextStore::Slot TextStore::slot_or_new(const UnitKey& key) const {
  if (const auto there = slots_.find(key); there != slots_.end()) return there->second;
  Slot slot;
  slot.number = next_slot_;
  slot.unit = waiting_unit(key);
  return slot;
}

std::vector<std::string> TextStore::slot_records(const Slot& slot) const {
  std::vector<std::string> records;
  if (slot.n_grasps > 0)
    read_lines(slot_path(slot.unit.key), "grasps", [&](const Json& line) { records.push_back(line.dump()); });
  return records;
}

/// Changes the state of a unit, with its grasps as they are.
void TextStore::rewrite(Slot& slot, const StoredUnit& unit) {
  Slot next = slot;
  next.unit = unit;
  write_files({{slot_path(unit.key), slot_text(next, slot_records(slot))}});
  keep(next);
}

std::size_t TextStore::add_units(const std::vector<UnitKey>& keys) {
  const std::lock_guard lock(mutex_);
  require_writable();
  Files files;
  std::map<UnitKey, Slot> fresh;
  std::int64_t number = order_.empty() ? 0 : order_.rbegin()->first + 1;
  std::int64_t new_slots = 0;
  for (const UnitKey& key : keys) {
    require_key(key);
    Slot slot = slot_or_new(key);
    if (slot.unit_number >= 0 || fresh.contains(key)) continue;
    if (!slots_.contains(key)) slot.number = next_slot_ + new_slots++;
    slot.unit_number = number++;
    files.emplace_back(slot_path(key), slot_text(slot, slot_records(slot)));
    fresh[key] = slot;
  }
  write_files(files);
  for (const auto& [key, slot] : fresh) keep(slot);
  return fresh.size();
}

std::vector<StoredUnit> TextStore::units() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredUnit> units;
  for (const auto& [number, key] : order_) units.push_back(slots_.at(key).unit);
  return units;
}

std::vector<StoredUnit> TextStore::claimed_units() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredUnit> units;
  for (const std::int64_t number : open_)
    if (const StoredUnit& u = slots_.at(order_.at(number)).unit; u.state == UnitState::claimed)
      units.push_back(u);
  return units;
}

/// The first unit that can be claimed, and all others of its object where the whole object is asked for.
std::vector<UnitKey> TextStore::claim(const std::string& worker, double lease_seconds, bool whole_object) {
  require_claim(worker, lease_seconds);
  const std::lock_guard lock(mutex_);
  require_writable();
  const double now = seconds_since_1970();
  std::vector<UnitKey> claimed;
  for (const std::int64_t number : std::vector<std::int64_t>(open_.begin(), open_.end())) {
    Slot& slot = slots_.at(order_.at(number));
    if (slot.unit.state == UnitState::claimed && slot.unit.lease_until >= now) continue;
    if (!claimed.empty() && claimed.front().object != slot.unit.key.object) continue;
    StoredUnit unit = slot.unit;
    unit.state = UnitState::claimed;
    unit.worker = worker;
    unit.lease_until = now + lease_seconds;
    rewrite(slot, unit);
    claimed.push_back(unit.key);
    if (!whole_object) break;
  }
  return claimed;
}

std::optional<UnitKey> TextStore::claim_unit(const std::string& worker, double lease_seconds) {
  const std::vector<UnitKey> claimed = claim(worker, lease_seconds, false);
  return claimed.empty() ? std::nullopt : std::optional(claimed.front());
}

std::vector<UnitKey> TextStore::claim_object(const std::string& worker, double lease_seconds) {
  return claim(worker, lease_seconds, true);
}

TextStore::Slot* TextStore::held_by(const UnitKey& key, const std::string& worker) {
  require_writable();
  require_key(key);
  const auto there = slots_.find(key);
  const bool held = there != slots_.end() && there->second.unit_number >= 0 &&
                    there->second.unit.state == UnitState::claimed && there->second.unit.worker == worker;
  return held ? &there->second : nullptr;
}

bool TextStore::renew_lease(const UnitKey& key, const std::string& worker, double lease_seconds) {
  require_claim(worker, lease_seconds);
  const std::lock_guard lock(mutex_);
  Slot* slot = held_by(key, worker);
  if (!slot) return false;
  StoredUnit unit = slot->unit;
  unit.lease_until = seconds_since_1970() + lease_seconds;
  rewrite(*slot, unit);
  return true;
}

bool TextStore::release_unit(const UnitKey& key, const std::string& worker) {
  const std::lock_guard lock(mutex_);
  Slot* slot = held_by(key, worker);
  if (!slot) return false;
  rewrite(*slot, waiting_unit(key));
  return true;
}

std::size_t TextStore::reopen_failed_units() {
  const std::lock_guard lock(mutex_);
  require_writable();
  std::size_t n = 0;
  for (const auto& [number, key] : order_) {
    Slot& slot = slots_.at(key);
    if (slot.unit.state != UnitState::failed) continue;
    rewrite(slot, waiting_unit(key));
    ++n;
  }
  return n;
}

std::vector<bool> TextStore::finish_units(const std::vector<UnitResult>& results) {
  const std::lock_guard lock(mutex_);
  require_writable();
  Files files;
  std::map<UnitKey, Slot> changed;
  std::vector<bool> stored;
  std::int64_t number = order_.empty() ? 0 : order_.rbegin()->first + 1;
  std::int64_t new_slots = 0;
  for (const UnitResult& r : results) {
    require_sound(r);
    require_key(r.key);
    require_sources(r.grasps);
    Slot slot = slot_or_new(r.key);
    const bool ended =
        slot.unit_number >= 0 && (slot.unit.state == UnitState::done || slot.unit.state == UnitState::failed);
    stored.push_back(!ended && !changed.contains(r.key));
    if (!stored.back()) continue;
    if (!slots_.contains(r.key)) slot.number = next_slot_ + new_slots++;
    if (slot.unit_number < 0) slot.unit_number = number++;
    std::vector<std::string> records = slot_records(slot);
    for (std::string& line : lines_of(r.grasps)) records.push_back(std::move(line));
    slot.unit = {r.key, r.state, r.reason, r.worker, 0.0, r.seconds};
    slot.n_grasps = records.size();
    files.emplace_back(slot_path(r.key), slot_text(slot, records));
    changed[r.key] = slot;
  }
  write_files(files);
  for (const auto& [key, slot] : changed) keep(slot);
  return stored;
}

void TextStore::add_grasps(const UnitKey& key, const std::vector<StoredGrasp>& grasps) {
  require_sound(key, grasps);
  const std::lock_guard lock(mutex_);
  require_writable();
  require_key(key);
  require_sources(grasps);
  Slot slot = slot_or_new(key);
  std::vector<std::string> records = slot_records(slot);
  for (std::string& line : lines_of(grasps)) records.push_back(std::move(line));
  slot.n_grasps = records.size();
  write_files({{slot_path(key), slot_text(slot, records)}});
  keep(slot);
}

std::vector<StoredGrasp> TextStore::grasps(const std::string& model, const std::string& hand) {
  const std::lock_guard lock(mutex_);
  require_model(model);
  require_key({model, find_model(model)->scales.front(), hand});
  std::vector<StoredGrasp> grasps;
  for (const double scale : find_model(model)->scales) {
    const auto there = slots_.find({model, scale, hand});
    if (there == slots_.end() || there->second.n_grasps == 0) continue;
    std::int64_t id = kIdsOfSlot * there->second.number;
    read_lines(slot_path(there->first), "grasps", [&](const Json& line) {
      StoredGrasp& g = grasps.emplace_back();
      from_line(line, g);
      g.id = ++id;
      g.grasp.object = model;
      g.grasp.object_scale = scale;
      g.grasp.hand = hand;
    });
  }
  return grasps;
}

}  // namespace eigengrasp
