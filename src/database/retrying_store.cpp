// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/retrying_store.hpp"

#include <algorithm>
#include <thread>
#include <type_traits>

namespace eigengrasp {

template <typename Call>
auto RetryingStore::persist(const Call& call) -> decltype(call()) {
  const Clock::time_point begin = Clock::now();
  for (int attempt = 0;; ++attempt) {
    try {
      if constexpr (std::is_void_v<decltype(call())>) {
        call();
        return note_success();
      } else {
        auto result = call();
        note_success();
        return result;
      }
    } catch (const TransientError& error) {
      wait(error, begin, attempt);
    }
  }
}

/// Before the next attempt. @throws Error where the time is over, for the call or for the outage: when one
/// thread has given up, the others do so at once.
void RetryingStore::wait(const TransientError& error, Clock::time_point begin, int attempt) {
  if (options_.retry_seconds <= 0.0) throw error;
  const auto seconds_since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  {
    const std::scoped_lock lock(mutex_);
    if (!outage_) outage_ = Clock::now();
    if (std::max(seconds_since(begin), seconds_since(*outage_)) >= options_.retry_seconds)
      fail("{}; tried again for {} s; what has ended is stored, and the same command goes on", error.what(),
           options_.retry_seconds);
    if (attempt > 0 && !told_ && options_.log) {  // the first time often goes well at once
      options_.log(fmt::format("{}; trying again for up to {} s", error.what(), options_.retry_seconds));
      told_ = true;
    }
  }
  constexpr double first = 0.05, longest = 1.0;  // [s]
  std::this_thread::sleep_for(std::chrono::duration<double>(
      std::min({first * (1 << std::min(attempt, 10)), longest, options_.retry_seconds})));
}

void RetryingStore::note_success() {
  const std::scoped_lock lock(mutex_);
  outage_.reset();
  if (told_ && options_.log) options_.log("the server answers again; the work goes on");
  told_ = false;
}

RetryingStore::RetryingStore(const std::function<std::unique_ptr<GraspStore>()>& open,
                             const StoreOptions& options)
    : options_(options) {
  store_ = persist(open);
}

StoreCounts RetryingStore::counts() {
  return persist([&] { return store_->counts(); });
}

bool RetryingStore::add_model(const StoredModel& model) {
  return persist([&] { return store_->add_model(model); });
}

std::vector<StoredModel> RetryingStore::models() {
  return persist([&] { return store_->models(); });
}

bool RetryingStore::add_hand(const StoredHand& hand) {
  return persist([&] { return store_->add_hand(hand); });
}

std::vector<StoredHand> RetryingStore::hands() {
  return persist([&] { return store_->hands(); });
}

bool RetryingStore::add_source(const GraspSource& source) {
  return persist([&] { return store_->add_source(source); });
}

std::vector<GraspSource> RetryingStore::sources() {
  return persist([&] { return store_->sources(); });
}

std::size_t RetryingStore::add_units(const std::vector<UnitKey>& keys) {
  return persist([&] { return store_->add_units(keys); });
}

std::vector<StoredUnit> RetryingStore::units() {
  return persist([&] { return store_->units(); });
}

std::vector<StoredUnit> RetryingStore::claimed_units() {
  return persist([&] { return store_->claimed_units(); });
}

std::optional<UnitKey> RetryingStore::claim_unit(const std::string& worker, double lease_seconds) {
  return persist([&] { return store_->claim_unit(worker, lease_seconds); });
}

std::vector<UnitKey> RetryingStore::claim_object(const std::string& worker, double lease_seconds) {
  return persist([&] { return store_->claim_object(worker, lease_seconds); });
}

bool RetryingStore::renew_lease(const UnitKey& key, const std::string& worker, double lease_seconds) {
  return persist([&] { return store_->renew_lease(key, worker, lease_seconds); });
}

bool RetryingStore::release_unit(const UnitKey& key, const std::string& worker) {
  return persist([&] { return store_->release_unit(key, worker); });
}

std::vector<bool> RetryingStore::finish_units(const std::vector<UnitResult>& results) {
  return persist([&] { return store_->finish_units(results); });
}

std::size_t RetryingStore::reopen_failed_units() {
  return persist([&] { return store_->reopen_failed_units(); });
}

void RetryingStore::add_grasps(const UnitKey& key, const std::vector<StoredGrasp>& grasps) {
  persist([&] {
    try {
      store_->add_grasps(key, grasps);
    } catch (const TransientError& error) {
      if (!error.may_be_stored()) throw;
      fail("{} while grasps were stored; see with 'eigengrasp db show' whether they are there", error.what());
    }
  });
}

std::vector<StoredGrasp> RetryingStore::grasps(const std::string& model, const std::string& hand) {
  return persist([&] { return store_->grasps(model, hand); });
}

void RetryingStore::set_descriptors(const std::vector<StoredDescriptor>& descriptors) {
  persist([&] { store_->set_descriptors(descriptors); });
}

std::vector<StoredDescriptor> RetryingStore::descriptors(const std::string& function) {
  return persist([&] { return store_->descriptors(function); });
}

std::vector<std::string> RetryingStore::described(const std::string& function) {
  return persist([&] { return store_->described(function); });
}

void RetryingStore::set_neighbors(const std::vector<StoredNeighbor>& neighbors) {
  persist([&] { store_->set_neighbors(neighbors); });
}

std::vector<StoredNeighbor> RetryingStore::neighbors() {
  return persist([&] { return store_->neighbors(); });
}

void RetryingStore::set_alignments(const std::vector<StoredAlignment>& alignments) {
  persist([&] { store_->set_alignments(alignments); });
}

std::vector<StoredAlignment> RetryingStore::alignments() {
  return persist([&] { return store_->alignments(); });
}

}  // namespace eigengrasp
