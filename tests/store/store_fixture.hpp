// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <gtest/gtest.h>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/temporary_folder.hpp"
#include "eigengrasp/database/grasp_store.hpp"
#include "support/postgres_server.hpp"
#include "support/random_grasps.hpp"

namespace eigengrasp::testing {

inline const char* const kStoreKinds[] = {"sqlite", "text", "postgresql"};

/// An empty folder, and addresses of new stores of all kinds.
class StoreFixture : public ::testing::Test {
 protected:
  static bool available(const std::string& kind) {
    return kind != "postgresql" || PostgresServer::instance();
  }
  std::string new_address(const std::string& kind) {
    const std::string name = fmt::format("store{}", count_++);
    if (kind == "sqlite") return fmt::format("sqlite:{}/{}.db", folder_.string(), name);
    if (kind == "text") return fmt::format("text:{}/{}", folder_.string(), name);
    return PostgresServer::instance()->make_database();
  }

  /// Two objects, two hands, a source.
  static void fill_tables(GraspStore& store) {
    store.add_model({"psb_12",
                     "/meshes/m12.off",
                     "0123",
                     {"plane", "F \"117\", {old}"},
                     0.1234567890123456,
                     0.07,
                     "",
                     {0.75, 1.0, 1.25, 1.5}});
    store.add_model(
        {"glass", "/meshes/glass \\ é.obj", "4567", {}, 1.0, 0.05, "thumbnails/glass.png", {0.75, 1.0}});
    store.add_hand(stored_hand("human", 20));
    store.add_hand(stored_hand("barrett", 7));
    store.add_source({"planner", "annealing, \"staged\""});
  }

  static UnitResult done(const UnitKey& key, std::size_t n, std::uint64_t seed) {
    const StoredHand hand = stored_hand(key.hand, key.hand == "human" ? 20 : 7);
    return {key, UnitState::done, "", "worker 1", 0.25, RandomGrasps(seed).grasps(key, hand, n)};
  }

  static void expect_same(const std::vector<StoredGrasp>& found, const std::vector<StoredGrasp>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].source, expected[i].source) << i;
      EXPECT_EQ(bits_of(found[i].grasp), bits_of(expected[i].grasp)) << i;
    }
  }

  /// The sentence that a call throws.
  template <typename Call>
  static std::string error_of(Call&& call) {
    try {
      call();
    } catch (const Error& e) {
      return e.what();
    }
    return "(no error)";
  }

  TemporaryFolder scratch_{"store"};
  std::filesystem::path folder_ = scratch_.path();

 private:
  int count_ = 0;
};

/// Expects one sentence that holds all of these parts.
inline void expect_sentence(const std::string& sentence, const std::vector<std::string>& parts) {
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  for (const std::string& part : parts) EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

}  // namespace eigengrasp::testing
