// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// A PostgreSQL server that goes and comes back, loses a commit, or ends transactions because of others.
#include <chrono>
#include <thread>

#include "store/store_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::expect_sentence;
using testing::PostgresServer;

class Outages : public testing::StoreFixture {
 protected:
  void SetUp() override {
    if (!available("postgresql")) GTEST_SKIP() << PostgresServer::why_none();
    address_ = new_address("postgresql");
  }

  std::unique_ptr<GraspStore> open(double retry_seconds) {
    StoreOptions options;
    options.retry_seconds = retry_seconds;
    options.log = [this](const std::string& sentence) { heard_.push_back(sentence); };
    auto store = open_store(address_, options);
    fill_tables(*store);
    store->add_units({unit_});
    return store;
  }

  /// A trigger on a table that does something the first times a row is written. Sequences count on when a
  /// transaction is rolled back.
  void interfere(const std::string& table, const std::string& when, int times, const std::string& statement) {
    PostgresServer::query(address_, "CREATE SEQUENCE calls");
    PostgresServer::query(
        address_, fmt::format("CREATE FUNCTION interfere() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
                              "IF nextval('calls') <= {} THEN {}; END IF; RETURN NEW; END $$",
                              times, statement));
    PostgresServer::query(
        address_, fmt::format("CREATE CONSTRAINT TRIGGER interfere AFTER INSERT OR UPDATE ON {} {} FOR EACH "
                              "ROW EXECUTE FUNCTION interfere()",
                              table, when));
  }
  static constexpr const char* kAtCommit = "DEFERRABLE INITIALLY DEFERRED";
  static constexpr const char* kEndSession = "PERFORM pg_terminate_backend(pg_backend_pid())";

  std::string address_;
  std::vector<std::string> heard_;
  const UnitKey unit_{"psb_12", 1.0, "human"};
};

TEST_F(Outages, deadlocks_and_serialization_failures_are_tried_again) {
  const auto store = open(20.0);
  for (const char* state : {"40001", "40P01"}) {
    SCOPED_TRACE(state);
    interfere("work_unit", "", 2, fmt::format("RAISE EXCEPTION USING ERRCODE = '{}'", state));
    EXPECT_EQ(store->claim_unit("worker", 100.0), unit_);
    EXPECT_TRUE(store->release_unit(unit_, "worker"));
    PostgresServer::query(address_, "DROP TRIGGER interfere ON work_unit");
    PostgresServer::query(address_, "DROP FUNCTION interfere");
    PostgresServer::query(address_, "DROP SEQUENCE calls");
  }
}

TEST_F(Outages, a_unit_whose_commit_is_lost_is_stored_once) {
  const auto store = open(20.0);
  interfere("work_unit", kAtCommit, 1, kEndSession);
  EXPECT_TRUE(store->finish_unit(done(unit_, 3, 1)));
  EXPECT_EQ(store->counts().grasps, 3);
  EXPECT_EQ(store->counts().done, 1);
  EXPECT_FALSE(store->finish_unit(done(unit_, 3, 2)));
}

TEST_F(Outages, grasps_without_a_unit_are_not_stored_again_where_the_commit_was_lost) {
  const auto store = open(20.0);
  const auto grasps = done(unit_, 2, 1).grasps;
  interfere("grasp", kAtCommit, 1, kEndSession);
  expect_sentence(error_of([&] { store->add_grasps(unit_, grasps); }), {"was lost", "db show"});
  store->add_grasps(unit_, grasps);
  EXPECT_EQ(store->counts().grasps, 2);
}

TEST_F(Outages, a_server_that_comes_back_is_waited_for) {
  const auto store = open(60.0);
  PostgresServer::instance()->stop();
  std::thread later([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    PostgresServer::instance()->start();
  });
  EXPECT_TRUE(store->finish_unit(done(unit_, 3, 1)));
  later.join();
  EXPECT_EQ(store->counts().grasps, 3);
  ASSERT_EQ(heard_.size(), 2u);
  expect_sentence(heard_[0], {"server", "trying again for up to 60 s"});
  expect_sentence(heard_[1], {"answers again"});
}

TEST_F(Outages, a_worker_that_joins_waits_for_the_server) {
  open(1.0);
  PostgresServer::instance()->stop();
  StoreOptions options;
  options.retry_seconds = 60.0;
  EXPECT_NE(error_of([&] { open_store(address_, options); }), "(no error)");
  options.await_server = true;
  std::thread later([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    PostgresServer::instance()->start();
  });
  EXPECT_EQ(open_store(address_, options)->counts().waiting, 1);
  later.join();
}

TEST_F(Outages, a_server_that_stays_away_is_given_up) {
  const auto store = open(0.5);
  PostgresServer::instance()->stop();
  expect_sentence(error_of([&] { store->counts(); }), {"server", "tried again for 0.5 s", "goes on"});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(error_of([&] { store->units(); }), "(no error)");  // at once
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(400));
  PostgresServer::instance()->start();
  EXPECT_EQ(store->claim_unit("worker", 100.0), unit_);
}

}  // namespace
}  // namespace eigengrasp
