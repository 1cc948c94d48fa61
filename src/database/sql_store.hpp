// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <mutex>

#include "database/sql_connection.hpp"

namespace eigengrasp {

/// A grasp store over an SQL database; what SQLite and PostgreSQL have in common, which is nearly all.
class SqlStore : public GraspStore {
 public:
  SqlStore(std::unique_ptr<SqlConnection> connection, StoreAccess access);

  std::string place() const override { return db_->place(); }
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
  /// A unit by the ids of its rows.
  struct Slot {
    std::int64_t scaled_model = 0, hand = 0;
  };
  struct KnownHand {
    std::int64_t id = 0;
    StoredHand hand;
  };

  // Statements.
  std::string sql(const std::string& text) const;
  std::int64_t count(const std::string& query, const std::vector<SqlValue>& values = {});
  bool affects(const std::string& statement, const std::vector<SqlValue>& values);

  // Ids of records, which are remembered: rows are never deleted. @throws Error for a name that is not there.
  std::int64_t model_id(const std::string& name);
  std::int64_t source_id(const std::string& name);
  const std::string& source_name(std::int64_t id);
  const KnownHand& known_hand(const std::string& name);
  Slot slot_of(const UnitKey& key);
  std::int64_t id_of_method(const std::string& table, const std::string& name);

  // Parts of the calls above.
  std::vector<StoredModel> models_where(const std::string& condition, const std::vector<SqlValue>& values);
  std::vector<StoredHand> hands_where(const std::string& condition, const std::vector<SqlValue>& values);
  std::vector<StoredUnit> units_where(const std::string& condition);
  bool add_scales(const std::string& model, const std::vector<double>& scales);
  std::optional<Slot> claim_first(const std::string& worker, double lease_seconds);
  UnitKey key_of(Slot slot);
  bool store_outcome(const UnitResult& result, Slot slot);
  void append_rows(const UnitKey& key, Slot slot, const std::vector<StoredGrasp>& grasps,
                   std::vector<GraspRow>& rows);
  StoredGrasp read_client_grasp(std::int64_t id, const std::string& where);

  std::unique_ptr<SqlConnection> db_;
  std::mutex mutex_;
  std::map<std::string, std::int64_t> model_ids_, source_ids_;
  std::map<std::int64_t, std::string> source_names_;
  std::map<std::string, KnownHand> hands_;
  std::map<std::pair<std::string, double>, std::int64_t> scaled_ids_;
};

}  // namespace eigengrasp
