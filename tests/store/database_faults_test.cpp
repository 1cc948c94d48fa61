// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Writers that are killed and disks that are full: no half units, none twice, and the store goes on.
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>

#include <map>
#include <thread>

#include "store/store_fixture.hpp"

namespace eigengrasp {
namespace {

class StoreFaults : public testing::StoreFixture, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (!available(GetParam())) GTEST_SKIP() << testing::PostgresServer::why_none();
  }

  static constexpr int kUnits = 400;
  static constexpr std::size_t kGrasps = 10;
  static UnitKey key(int i) { return {"many", 0.01 * (i + 1), "human"}; }

  static void add_units(GraspStore& store) {
    fill_tables(store);
    StoredModel many = store.models()[1];
    many.name = "many";
    many.scales.clear();
    std::vector<UnitKey> keys;
    for (int i = 0; i < kUnits; ++i) {
      many.scales.push_back(key(i).scale);
      keys.push_back(key(i));
    }
    store.add_model(many);
    store.add_units(keys);
  }

  /// A process that claims and finishes units until it is killed.
  static pid_t start_worker(const std::string& address, std::uint64_t seed) {
    const pid_t pid = ::fork();
    if (pid != 0) return pid;
    try {
      const auto store = open_store(address);
      while (const auto unit = store->claim_unit("worker", 0.0))
        store->finish_unit(done(*unit, kGrasps, seed));
    } catch (const std::exception& e) {
      fmt::print(stderr, "worker: {}\n", e.what());
      ::_exit(1);
    }
    ::_exit(0);
  }

  /// Every unit that is done has all of its grasps, every other none.
  static void expect_whole_units(GraspStore& store) {
    std::map<double, std::size_t> grasps;
    for (const StoredGrasp& g : store.grasps("many", "human")) ++grasps[g.grasp.object_scale];
    const auto units = store.units();
    ASSERT_EQ(units.size(), static_cast<std::size_t>(kUnits));
    for (const StoredUnit& u : units)
      EXPECT_EQ(grasps[u.key.scale], u.state == UnitState::done ? kGrasps : 0u) << u.key.scale;
  }
};

INSTANTIATE_TEST_SUITE_P(AllStores, StoreFaults, ::testing::ValuesIn(testing::kStoreKinds),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_P(StoreFaults, killed_writers_leave_whole_units) {
  const std::string address = new_address(GetParam());
  add_units(*open_store(address));
  std::int64_t last = 0;
  for (unsigned round = 0; round < 12; ++round) {
    const pid_t worker = start_worker(address, round);
    std::this_thread::sleep_for(std::chrono::milliseconds(8 + round * 37 % 60));
    ::kill(worker, SIGKILL);
    ::waitpid(worker, nullptr, 0);
    const auto store = open_store(address);
    expect_whole_units(*store);
    EXPECT_GE(store->counts().done, last);  // nothing is lost
    last = store->counts().done;
  }
  int status = 1;
  ::waitpid(start_worker(address, 99), &status, 0);
  EXPECT_EQ(status, 0);
  const auto store = open_store(address);
  expect_whole_units(*store);
  EXPECT_EQ(store->counts().done, kUnits);
}

/// Stores whose disk is this program's.
class FullDisk : public StoreFaults {};
INSTANTIATE_TEST_SUITE_P(FileStores, FullDisk, ::testing::Values("sqlite", "text"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_P(FullDisk, is_said_and_leaves_whole_units) {
  const auto disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=3m") != 0)
    GTEST_SKIP() << "SKIPPED: a small disk needs the right to mount one";
  {
    const std::string kind = GetParam();
    const std::string address = kind + ":" + (disk / (kind == "text" ? "store" : "store.db")).string();
    const auto store = open_store(address);
    add_units(*store);
    std::string sentence = "(no error)";
    for (int i = 0; i < kUnits && sentence == "(no error)"; ++i)
      sentence = error_of([&] { store->finish_unit(done(key(i), kGrasps, 1)); });
    EXPECT_TRUE(sentence.find("disk is full") != std::string::npos ||
                sentence.find("No space left") != std::string::npos)
        << sentence;
    expect_whole_units(*store);
    EXPECT_GT(store->counts().done, 0);
  }
  EXPECT_EQ(::umount(disk.c_str()), 0);
}

}  // namespace
}  // namespace eigengrasp
