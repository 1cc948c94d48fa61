// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <chrono>
#include <functional>
#include <mutex>

#include "database/transient_error.hpp"
#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp {

/// Passes calls on to a store, and makes those again that end with TransientError, for as many seconds as the
/// options say. Made again, a call stores nothing twice: records and units have names, and the first outcome
/// of a unit counts. Only grasps without a unit have none: add_grasps is not made again where it may have
/// been stored. What a call returns about new records is that of the last time it was made.
class RetryingStore : public GraspStore {
 public:
  /// @param open makes the store; made again like any call
  RetryingStore(const std::function<std::unique_ptr<GraspStore>()>& open, const StoreOptions& options);

  std::string place() const override { return store_->place(); }
  StoreCounts counts() override;
  bool add_model(const StoredModel& model) override;
  std::vector<StoredModel> models() override;
  bool add_hand(const StoredHand& hand) override;
  std::vector<StoredHand> hands() override;
  bool add_source(const GraspSource& source) override;
  std::vector<GraspSource> sources() override;
  std::size_t add_units(const std::vector<UnitKey>& keys) override;
  std::vector<StoredUnit> units() override;
  std::vector<StoredUnit> claimed_units() override;
  std::optional<UnitKey> claim_unit(const std::string& worker, double lease_seconds) override;
  std::vector<UnitKey> claim_object(const std::string& worker, double lease_seconds) override;
  bool renew_lease(const UnitKey& key, const std::string& worker, double lease_seconds) override;
  bool release_unit(const UnitKey& key, const std::string& worker) override;
  std::vector<bool> finish_units(const std::vector<UnitResult>& results) override;
  std::size_t reopen_failed_units() override;
  void add_grasps(const UnitKey& key, const std::vector<StoredGrasp>& grasps) override;
  std::vector<StoredGrasp> grasps(const std::string& model, const std::string& hand) override;
  void set_descriptors(const std::vector<StoredDescriptor>& descriptors) override;
  std::vector<StoredDescriptor> descriptors(const std::string& function) override;
  std::vector<std::string> described(const std::string& function) override;
  void set_neighbors(const std::vector<StoredNeighbor>& neighbors) override;
  std::vector<StoredNeighbor> neighbors() override;
  void set_alignments(const std::vector<StoredAlignment>& alignments) override;
  std::vector<StoredAlignment> alignments() override;

 private:
  using Clock = std::chrono::steady_clock;

  template <typename Call>
  auto persist(const Call& call) -> decltype(call());
  void wait(const TransientError& error, Clock::time_point begin, int attempt);
  void note_success();

  StoreOptions options_;
  std::mutex mutex_;                         ///< of the two below; calls of several threads fail together
  std::optional<Clock::time_point> outage_;  ///< since when calls fail
  bool told_ = false;                        ///< of the outage
  std::unique_ptr<GraspStore> store_;
};

}  // namespace eigengrasp
