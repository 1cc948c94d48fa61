// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include "database/folder_lock.hpp"
#include "database/text_lines.hpp"
#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp {

/// A grasp store in text files (docs/grasp-store.md). All but the grasps is in memory too.
class TextStore : public GraspStore {
 public:
  TextStore(const std::filesystem::path& folder, const StoreOptions& options);

  std::string place() const override { return "text:" + folder_.string(); }
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
  using Files = std::vector<std::pair<std::filesystem::path, std::string>>;

  /// An object at a scale with a hand: one file.
  struct Slot {
    std::int64_t number = 0;        ///< in the order in which the files were made
    std::int64_t unit_number = -1;  ///< in the order of the units; -1: grasps only
    StoredUnit unit;                ///< where unit_number >= 0; its key in any case
    std::size_t n_grasps = 0;
  };

  // Files.
  std::filesystem::path slot_path(const UnitKey& key) const;
  std::string slot_text(const Slot& slot, const std::vector<std::string>& records) const;
  std::vector<std::string> slot_records(const Slot& slot) const;
  void read_folder();
  void read_slot(const std::filesystem::path& file);
  void require_writable() const;
  template <typename Record>
  void read_list(const char* kind, std::vector<Record>& into) const;
  template <typename Record>
  void write_list(const char* kind, const std::vector<Record>& records) const;
  template <typename Record>
  bool add_to(const char* kind, std::vector<Record>& records, const Record& record);

  // What is in memory.
  const StoredModel* find_model(const std::string& name) const;
  void require_key(const UnitKey& key) const;
  void require_model(const std::string& name) const;
  void require_sources(const std::vector<StoredGrasp>& grasps) const;
  Slot slot_or_new(const UnitKey& key) const;
  std::vector<UnitKey> claim(const std::string& worker, double lease_seconds, bool whole_object);
  void keep(const Slot& slot);
  Slot* held_by(const UnitKey& key, const std::string& worker);
  void rewrite(Slot& slot, const StoredUnit& unit);

  std::filesystem::path folder_;
  StoreOptions options_;
  std::unique_ptr<FolderLock> lock_;
  std::mutex mutex_;
  std::vector<StoredModel> models_;
  std::vector<StoredHand> hands_;
  std::vector<GraspSource> sources_;
  std::vector<StoredDescriptor> descriptors_;
  std::vector<StoredNeighbor> neighbors_;
  std::vector<StoredAlignment> alignments_;
  std::map<UnitKey, Slot> slots_;
  std::map<std::int64_t, UnitKey> order_;  ///< of the units
  std::set<std::int64_t> open_;            ///< units that wait or are claimed
  std::int64_t next_slot_ = 0;
};

}  // namespace eigengrasp
