// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/core/log.hpp"
#include "eigengrasp/database/store_records.hpp"

namespace eigengrasp {

/// A database of grasps. All kinds of store keep the same laws:
/// - What is read back equals bit by bit what was stored.
/// - Every list is in the order in which its records were added; grasps are in the order of their units'
///   scales, then in that in which they were stored.
/// - A call that writes either does all of it or, where it throws, nothing.
/// - A record that is there already is not stored again; one of the same name with another content is an
/// Error.
/// - One object may be used by several threads (calls wait for each other). Several objects, in several
///   programs or on several machines, may use one SQLite or PostgreSQL store; a text store has one writer.
/// All calls throw Error, in a sentence, for what names a record that is not there, numbers that are not
/// finite, and a store that cannot be read or written.
class GraspStore {
 public:
  virtual ~GraspStore() = default;

  /// Where it is, without a password.
  virtual std::string place() const = 0;
  virtual StoreCounts counts() = 0;

  /// Adds an object and its scaled models. A model that is there with other scales gets the missing ones.
  /// @returns whether anything was added.
  virtual bool add_model(const StoredModel& model) = 0;
  virtual std::vector<StoredModel> models() = 0;
  virtual bool add_hand(const StoredHand& hand) = 0;
  virtual std::vector<StoredHand> hands() = 0;
  virtual bool add_source(const GraspSource& source) = 0;
  virtual std::vector<GraspSource> sources() = 0;

  /// Adds units that wait; those that are there stay as they are. @returns the number of new ones.
  virtual std::size_t add_units(const std::vector<UnitKey>& keys) = 0;
  virtual std::vector<StoredUnit> units() = 0;
  /// Those of them that are claimed. Cost: does not grow with the number of units that have ended.
  virtual std::vector<StoredUnit> claimed_units() = 0;

  /// The first unit that waits, or whose lease has ended, is the worker's for some seconds. No two callers
  /// get the same unit while the lease lasts. Cost: does not grow with the number of units that are done.
  virtual std::optional<UnitKey> claim_unit(const std::string& worker, double lease_seconds) = 0;
  /// The unit that claim_unit would claim, and with it all others of its object that could be claimed, in
  /// their order: what is prepared of an object serves all of them. Where several claim at the same moment an
  /// object's units may be shared out among them. Empty: nothing is left to claim.
  virtual std::vector<UnitKey> claim_object(const std::string& worker, double lease_seconds) = 0;
  /// The lease lasts for so many seconds from now. @returns false where the worker does not hold the unit.
  virtual bool renew_lease(const UnitKey& key, const std::string& worker, double lease_seconds) = 0;
  /// Gives a claimed unit back. @returns false where the worker does not hold the unit.
  virtual bool release_unit(const UnitKey& key, const std::string& worker) = 0;

  /// Stores the grasps of units together with their states, in one transaction. A unit that is done or failed
  /// already is left as it is; one that is not in the store is added. Who holds the lease does not matter: a
  /// unit's result is the same whoever works it out, and the first one counts.
  /// @returns which units were stored.
  virtual std::vector<bool> finish_units(const std::vector<UnitResult>& results) = 0;
  bool finish_unit(const UnitResult& result) { return finish_units({result}).front(); }
  /// Lets the failed units wait again. @returns how many.
  virtual std::size_t reopen_failed_units() = 0;

  /// Stores grasps that do not come from a unit of work, behind those that are there.
  virtual void add_grasps(const UnitKey& key, const std::vector<StoredGrasp>& grasps) = 0;
  /// All grasps of an object, at all scales, with a hand.
  virtual std::vector<StoredGrasp> grasps(const std::string& model, const std::string& hand) = 0;

  /// A descriptor of the same object by the same function takes the place of the old one.
  virtual void set_descriptors(const std::vector<StoredDescriptor>& descriptors) = 0;
  /// Those by one function, or all where it is empty; in the order in which objects were described.
  virtual std::vector<StoredDescriptor> descriptors(const std::string& function) = 0;
  /// Names of the objects that have a descriptor by the function.
  virtual std::vector<std::string> described(const std::string& function) = 0;
  /// A distance of the same pair by the same function takes the place of the old one. Alignments likewise.
  virtual void set_neighbors(const std::vector<StoredNeighbor>& neighbors) = 0;
  virtual std::vector<StoredNeighbor> neighbors() = 0;
  virtual void set_alignments(const std::vector<StoredAlignment>& alignments) = 0;
  virtual std::vector<StoredAlignment> alignments() = 0;
};

enum class StoreAccess {
  read,    ///< the store must be there; nothing of it is changed
  update,  ///< the store must be there; brought up to date where it is of an older version
  write,   ///< as update, and made where it is missing
};

struct StoreOptions {
  StoreAccess access = StoreAccess::write;
  double lock_seconds = 10.0;  ///< how long a write waits for another program's
  /// PostgreSQL: how long a call is made again where the server goes away or ends the transaction because of
  /// others.
  double retry_seconds = 60.0;
  bool await_server =
      false;         ///< so also where no server answers at the opening; else that is an Error at once
  LogSink log = {};  ///< hears of such a wait and of its end
};

/// Opens a store (docs/grasp-store.md):
///   sqlite:FILE                              one file, and two beside it while it is used
///   postgresql://USER:PASSWORD@HOST/DATABASE a database of a PostgreSQL server, 15 or newer
///   text:FOLDER                              text files, one record a line
/// @throws Error where the address is of no such form, or the store is missing, unreachable, foreign,
/// damaged, in use, or of a newer version than this program knows.
std::unique_ptr<GraspStore> open_store(const std::string& address, const StoreOptions& options = {});

}  // namespace eigengrasp
