// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/database/store_copy.hpp"

#include <map>
#include <set>

namespace eigengrasp {

namespace {

constexpr std::size_t kBatch = 64;  ///< units a transaction

bool has_outcome(const StoredUnit& unit) {
  return unit.state == UnitState::done || unit.state == UnitState::failed;
}

/// Copies the grasps and outcomes of units, hand by hand and object by object.
class UnitCopy {
 public:
  UnitCopy(GraspStore& from, GraspStore& to, CopyReport& report) : from_(from), to_(to), report_(report) {
    for (const StoredUnit& unit : from.units()) source_units_[unit.key] = unit;
    for (const StoredUnit& unit : to.units())
      if (has_outcome(unit)) ended_.insert(unit.key);
    target_has_grasps_ = to.counts().grasps > 0;
  }

  void copy_all(const std::vector<StoredModel>& models, const std::vector<StoredHand>& hands) {
    for (const StoredModel& model : models)
      for (const StoredHand& hand : hands) copy(model, hand.name);
    flush();
  }

 private:
  void copy(const StoredModel& model, const std::string& hand) {
    std::map<UnitKey, std::vector<StoredGrasp>> parts;
    for (StoredGrasp& g : from_.grasps(model.name, hand)) {
      const UnitKey key{model.name, g.grasp.object_scale, hand};
      parts[key].push_back(std::move(g));
    }
    const std::set<double> present = scales_with_grasps(model.name, hand);
    for (const double scale : model.scales) {
      const UnitKey key{model.name, scale, hand};
      const auto unit = source_units_.find(key);
      const bool ended = unit != source_units_.end() && has_outcome(unit->second);
      if (!ended && parts[key].empty()) continue;
      if (ended_.contains(key) || present.contains(scale)) {
        ++report_.kept_units;
      } else if (ended) {
        const StoredUnit& u = unit->second;
        batch_.push_back({key, u.state, u.reason, u.worker, u.seconds, std::move(parts[key])});
        if (batch_.size() >= kBatch) flush();
      } else {
        report_.grasps += static_cast<std::int64_t>(parts[key].size());
        to_.add_grasps(key, parts[key]);
      }
    }
  }

  std::set<double> scales_with_grasps(const std::string& model, const std::string& hand) {
    std::set<double> scales;
    if (target_has_grasps_)
      for (const StoredGrasp& g : to_.grasps(model, hand)) scales.insert(g.grasp.object_scale);
    return scales;
  }

  void flush() {
    const std::vector<bool> stored = to_.finish_units(batch_);
    for (std::size_t i = 0; i < batch_.size(); ++i)
      if (stored[i]) report_.grasps += static_cast<std::int64_t>(batch_[i].grasps.size());
    batch_.clear();
  }

  GraspStore& from_;
  GraspStore& to_;
  CopyReport& report_;
  std::map<UnitKey, StoredUnit> source_units_;
  std::set<UnitKey> ended_;
  bool target_has_grasps_ = false;
  std::vector<UnitResult> batch_;
};

}  // namespace

CopyReport copy_store(GraspStore& from, GraspStore& to) {
  CopyReport report;
  const auto models = from.models();
  const auto hands = from.hands();
  for (const StoredModel& model : models) report.models += to.add_model(model);
  for (const StoredHand& hand : hands) report.hands += to.add_hand(hand);
  for (const GraspSource& source : from.sources()) to.add_source(source);
  std::vector<UnitKey> keys;
  for (const StoredUnit& unit : from.units()) keys.push_back(unit.key);
  report.units = static_cast<std::int64_t>(to.add_units(keys));
  UnitCopy(from, to, report).copy_all(models, hands);
  to.set_descriptors(from.descriptors(""));
  to.set_neighbors(from.neighbors());
  to.set_alignments(from.alignments());
  return report;
}

}  // namespace eigengrasp
