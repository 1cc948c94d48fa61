// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Records and lists of a text store; its units and grasps are in text_slots.cpp.
#include "database/text_store.hpp"

#include <algorithm>
#include <tuple>

#include "database/record_checks.hpp"
#include "database/record_json.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

const char* kMark = "eigengrasp-store.jsonl";  ///< makes a folder a store

template <typename Record>
const Record* find_named(const std::vector<Record>& records, const std::string& name) {
  const auto found =
      std::find_if(records.begin(), records.end(), [&](const Record& r) { return r.name == name; });
  return found == records.end() ? nullptr : &*found;
}

/// Makes the folder a store, unless it holds something else.
void make_store(const fs::path& folder, const std::string& place) {
  std::error_code ec;
  if (fs::exists(folder, ec) && !fs::is_directory(folder, ec))
    fail("{}: is a file, expected a folder", place);
  if (fs::is_directory(folder, ec) && !fs::is_empty(folder, ec))
    fail("{}: the folder holds other files and no grasp store; name an empty or a new folder", place);
  require_writable_folder(folder);
  write_file_atomically(folder / kMark, format_lines("store", {}));
}

}  // namespace

TextStore::TextStore(const fs::path& folder, const StoreOptions& options)
    : folder_(folder), options_(options) {
  std::error_code ec;
  const bool writing = options.access != StoreAccess::read;
  if (!fs::exists(folder_ / kMark, ec)) {
    if (options.access != StoreAccess::write)
      fail("{}: is no grasp store (there is no {} in it)", place(), kMark);
    make_store(folder_, place());
  }
  if (writing) require_writable_folder(folder_);
  lock_ = std::make_unique<FolderLock>(folder_, writing, options.lock_seconds, place());
  read_folder();
}

void TextStore::require_writable() const {
  if (options_.access == StoreAccess::read) fail("{}: was opened for reading and cannot be written", place());
}

template <typename Record>
void TextStore::read_list(const char* kind, std::vector<Record>& into) const {
  const fs::path file = folder_ / (std::string(kind) + ".jsonl");
  if (!fs::exists(file)) return;
  read_lines(file, kind, [&](const nlohmann::ordered_json& line) { from_line(line, into.emplace_back()); });
}

template <typename Record>
void TextStore::write_list(const char* kind, const std::vector<Record>& records) const {
  TextLines lines;
  for (const Record& r : records) lines.records.push_back(to_line(r).dump());
  write_file_atomically(folder_ / (std::string(kind) + ".jsonl"), format_lines(kind, lines));
}

void TextStore::read_folder() {
  read_head(folder_ / kMark, "store");
  read_list("models", models_);
  read_list("hands", hands_);
  read_list("sources", sources_);
  read_list("descriptors", descriptors_);
  read_list("neighbors", neighbors_);
  read_list("alignments", alignments_);
  const fs::path grasps = folder_ / "grasps";
  if (!fs::exists(grasps)) return;
  for (const auto& entry : fs::recursive_directory_iterator(grasps))
    if (entry.path().extension() == ".jsonl") read_slot(entry.path());
}

StoreCounts TextStore::counts() {
  const std::lock_guard lock(mutex_);
  StoreCounts c;
  c.models = static_cast<std::int64_t>(models_.size());
  c.hands = static_cast<std::int64_t>(hands_.size());
  c.sources = static_cast<std::int64_t>(sources_.size());
  c.descriptors = static_cast<std::int64_t>(descriptors_.size());
  c.neighbors = static_cast<std::int64_t>(neighbors_.size());
  c.alignments = static_cast<std::int64_t>(alignments_.size());
  for (const StoredModel& m : models_) c.scaled_models += static_cast<std::int64_t>(m.scales.size());
  std::map<std::string, std::int64_t> by_hand;
  for (const auto& [key, slot] : slots_) {
    by_hand[key.hand] += static_cast<std::int64_t>(slot.n_grasps);
    c.grasps += static_cast<std::int64_t>(slot.n_grasps);
    if (slot.unit_number < 0) continue;
    const UnitState state = slot.unit.state;
    ++(state == UnitState::waiting   ? c.waiting
       : state == UnitState::claimed ? c.claimed
       : state == UnitState::done    ? c.done
                                     : c.failed);
  }
  for (const StoredHand& h : hands_) c.grasps_by_hand.emplace_back(h.name, by_hand[h.name]);
  return c;
}

/// @returns false where the same record is there.
template <typename Record>
bool TextStore::add_to(const char* kind, std::vector<Record>& records, const Record& record) {
  const std::lock_guard lock(mutex_);
  require_writable();
  if (const Record* there = find_named(records, record.name)) {
    require_same(*there, record);
    return false;
  }
  std::vector<Record> next = records;
  next.push_back(record);
  write_list(kind, next);
  records = std::move(next);
  return true;
}

bool TextStore::add_model(const StoredModel& model) {
  require_sound(model);
  if (add_to("models", models_, model)) return true;
  const std::lock_guard lock(mutex_);
  std::vector<StoredModel> next = models_;
  StoredModel& there = next[static_cast<std::size_t>(find_model(model.name) - models_.data())];
  const std::size_t before = there.scales.size();
  std::set<double> scales(there.scales.begin(), there.scales.end());
  scales.insert(model.scales.begin(), model.scales.end());
  there.scales.assign(scales.begin(), scales.end());
  if (there.scales.size() == before) return false;
  write_list("models", next);
  models_ = std::move(next);
  return true;
}

bool TextStore::add_hand(const StoredHand& hand) {
  require_sound(hand);
  return add_to("hands", hands_, hand);
}

bool TextStore::add_source(const GraspSource& source) {
  require_name(source.name, "a source");
  return add_to("sources", sources_, source);
}

std::vector<StoredModel> TextStore::models() {
  const std::lock_guard lock(mutex_);
  return models_;
}
std::vector<StoredHand> TextStore::hands() {
  const std::lock_guard lock(mutex_);
  return hands_;
}
std::vector<GraspSource> TextStore::sources() {
  const std::lock_guard lock(mutex_);
  return sources_;
}
std::vector<StoredDescriptor> TextStore::descriptors(const std::string& function) {
  const std::lock_guard lock(mutex_);
  std::vector<StoredDescriptor> found;
  for (const StoredDescriptor& d : descriptors_)
    if (function.empty() || d.function == function) found.push_back(d);
  return found;
}
std::vector<std::string> TextStore::described(const std::string& function) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const StoredDescriptor& d : descriptors_)
    if (d.function == function) names.push_back(d.model);
  return names;
}
std::vector<StoredNeighbor> TextStore::neighbors() {
  const std::lock_guard lock(mutex_);
  return neighbors_;
}
std::vector<StoredAlignment> TextStore::alignments() {
  const std::lock_guard lock(mutex_);
  return alignments_;
}

namespace {

/// Puts each record in the place of the one of the same key, else behind all.
template <typename Record, typename Key>
std::vector<Record> merged(std::vector<Record> all, const std::vector<Record>& records, Key key) {
  std::map<decltype(key(records.front())), std::size_t> places;
  for (std::size_t i = 0; i < all.size(); ++i) places.emplace(key(all[i]), i);
  for (const Record& r : records) {
    const auto [place, fresh] = places.emplace(key(r), all.size());
    if (fresh) {
      all.push_back(r);
    } else {
      all[place->second] = r;
    }
  }
  return all;
}

}  // namespace

void TextStore::set_descriptors(const std::vector<StoredDescriptor>& descriptors) {
  const std::lock_guard lock(mutex_);
  require_writable();
  for (const StoredDescriptor& d : descriptors) {
    require_sound(d);
    require_model(d.model);
  }
  auto next = merged(descriptors_, descriptors,
                     [](const StoredDescriptor& d) { return std::tuple(d.model, d.function); });
  write_list("descriptors", next);
  descriptors_ = std::move(next);
}

void TextStore::set_neighbors(const std::vector<StoredNeighbor>& neighbors) {
  const std::lock_guard lock(mutex_);
  require_writable();
  for (const StoredNeighbor& n : neighbors) {
    require_sound(n);
    require_model(n.model);
    require_model(n.neighbor);
  }
  auto next = merged(neighbors_, neighbors, [](const StoredNeighbor& n) {
    return std::tuple(n.model, n.neighbor, n.distance_function);
  });
  write_list("neighbors", next);
  neighbors_ = std::move(next);
}

void TextStore::set_alignments(const std::vector<StoredAlignment>& alignments) {
  const std::lock_guard lock(mutex_);
  require_writable();
  for (const StoredAlignment& a : alignments) {
    require_sound(a);
    require_model(a.model);
    require_model(a.target);
  }
  auto next = merged(alignments_, alignments,
                     [](const StoredAlignment& a) { return std::tuple(a.model, a.target, a.method); });
  write_list("alignments", next);
  alignments_ = std::move(next);
}

const StoredModel* TextStore::find_model(const std::string& name) const {
  return find_named(models_, name);
}

void TextStore::require_model(const std::string& name) const {
  if (!find_model(name))
    fail("{}: holds no object '{}'; 'eigengrasp db list' names those it holds", place(), name);
}

void TextStore::require_key(const UnitKey& key) const {
  if (!find_named(hands_, key.hand))
    fail("{}: holds no hand '{}'; 'eigengrasp db info' names those it holds", place(), key.hand);
  require_model(key.object);
  const auto& scales = find_model(key.object)->scales;
  if (std::find(scales.begin(), scales.end(), key.scale) == scales.end())
    fail("{}: holds object '{}', but not at scale {}; add the scale first", place(), key.object, key.scale);
}

void TextStore::require_sources(const std::vector<StoredGrasp>& grasps) const {
  for (const StoredGrasp& g : grasps)
    if (!find_named(sources_, g.source))
      fail("{}: holds no grasp source '{}'; add it first", place(), g.source);
}

}  // namespace eigengrasp
