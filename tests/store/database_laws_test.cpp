// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The laws of GraspStore (its header), for every kind of store.
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "store/store_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::bits_of;
using testing::expect_sentence;
using testing::RandomGrasps;
using testing::stored_hand;

class StoreLaws : public testing::StoreFixture, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (!available(GetParam())) GTEST_SKIP() << testing::PostgresServer::why_none();
    address_ = new_address(GetParam());
    store_ = open_store(address_);
    fill_tables(*store_);
  }
  void reopen() {
    store_.reset();
    store_ = open_store(address_);
  }

  const UnitKey glass_ = {"glass", 1.0, "human"};
  const UnitKey small_glass_ = {"glass", 0.75, "human"};
  const UnitKey plane_ = {"psb_12", 1.25, "barrett"};
  std::string address_;
  std::unique_ptr<GraspStore> store_;
};

INSTANTIATE_TEST_SUITE_P(AllStores, StoreLaws, ::testing::ValuesIn(testing::kStoreKinds),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_P(StoreLaws, records_read_back_equal_and_in_order) {
  for (int round = 0; round < 2; ++round) {
    const auto models = store_->models();
    ASSERT_EQ(models.size(), 2u);
    EXPECT_EQ(models[0].name, "psb_12");
    EXPECT_EQ(models[0].tags, (std::vector<std::string>{"plane", "F \"117\", {old}"}));
    EXPECT_EQ(models[0].rescale, 0.1234567890123456);
    EXPECT_EQ(models[1].geometry_path, "/meshes/glass \\ é.obj");
    EXPECT_EQ(models[1].scales, (std::vector<double>{0.75, 1.0}));
    EXPECT_EQ(store_->hands(),
              (std::vector<StoredHand>{stored_hand("human", 20), stored_hand("barrett", 7)}));
    EXPECT_EQ(store_->sources(), (std::vector<GraspSource>{{"planner", "annealing, \"staged\""}}));
    reopen();
  }
}

TEST_P(StoreLaws, adding_the_same_again_changes_nothing) {
  const StoreCounts before = store_->counts();
  const auto models = store_->models();
  EXPECT_FALSE(store_->add_model(models[0]));
  EXPECT_FALSE(store_->add_hand(stored_hand("human", 20)));
  EXPECT_FALSE(store_->add_source(store_->sources()[0]));
  EXPECT_EQ(store_->counts(), before);
  EXPECT_EQ(store_->models(), models);
}

TEST_P(StoreLaws, another_content_under_the_same_name_is_refused) {
  StoredModel other = store_->models()[1];
  other.content_hash = "other";
  expect_sentence(error_of([&] { store_->add_model(other); }), {"glass", "another geometry", "another name"});
  expect_sentence(error_of([&] { store_->add_hand(stored_hand("human", 5)); }), {"human", "other joints"});
  EXPECT_EQ(store_->models()[1].content_hash, "4567");
}

TEST_P(StoreLaws, a_model_gets_missing_scales) {
  StoredModel model = store_->models()[1];
  model.scales = {1.0, 1.75};
  EXPECT_TRUE(store_->add_model(model));
  EXPECT_EQ(store_->models()[1].scales, (std::vector<double>{0.75, 1.0, 1.75}));
  EXPECT_EQ(store_->counts().scaled_models, 7);
  EXPECT_TRUE(store_->finish_unit(done({"glass", 1.75, "human"}, 1, 3)));
}

TEST_P(StoreLaws, grasps_read_back_equal_bit_by_bit_in_order_of_scale_and_storing) {
  const UnitResult big = done(glass_, 7, 1), small = done(small_glass_, 5, 2), plane = done(plane_, 3, 3);
  EXPECT_TRUE(store_->finish_unit(big));
  EXPECT_EQ(store_->finish_units({plane, small}), (std::vector<bool>{true, true}));
  reopen();
  auto expected = small.grasps;
  expected.insert(expected.end(), big.grasps.begin(), big.grasps.end());
  const auto found = store_->grasps("glass", "human");
  expect_same(found, expected);
  expect_same(store_->grasps("psb_12", "barrett"), plane.grasps);
  EXPECT_TRUE(store_->grasps("glass", "barrett").empty());
  std::set<std::int64_t> ids;
  for (const StoredGrasp& g : found) ids.insert(g.id);
  EXPECT_EQ(ids.size(), found.size());
}

TEST_P(StoreLaws, awkward_grasps_read_back_equal_bit_by_bit) {
  RandomGrasps random(5);
  UnitResult r = done(glass_, 4, 4);
  Grasp& g = r.grasps[0].grasp;
  g.energy = -0.0;
  g.epsilon = std::numeric_limits<double>::denorm_min();
  g.volume = std::numeric_limits<double>::max();
  g.X_OH.translation().x() = std::nextafter(0.1, 1.0);
  g.provenance.seed = std::numeric_limits<std::uint64_t>::max();
  r.grasps[1].grasp.contacts.clear();
  r.grasps[1].grasp.amplitudes.resize(0);
  r.grasps[1].grasp.grasp_joints.clear();
  r.grasps[2].grasp.contacts[0].link = "a link that the hand does not have";
  r.grasps[2].grasp.grasp_joints[0].first = r.grasps[2].grasp.grasp_joints[1].first;  // twice
  std::swap(r.grasps[3].grasp.grasp_joints[0], r.grasps[3].grasp.grasp_joints[5]);    // another order
  ASSERT_TRUE(store_->finish_unit(r));
  expect_same(store_->grasps("glass", "human"), r.grasps);
}

TEST_P(StoreLaws, a_unit_is_never_stored_twice) {
  const UnitResult first = done(glass_, 3, 1), second = done(glass_, 4, 2);
  EXPECT_TRUE(store_->finish_unit(first));
  EXPECT_FALSE(store_->finish_unit(second));
  reopen();
  EXPECT_FALSE(store_->finish_unit(second));
  EXPECT_EQ(store_->finish_units({done(plane_, 2, 5), done(plane_, 2, 5)}), (std::vector<bool>{true, false}));
  expect_same(store_->grasps("glass", "human"), first.grasps);
  EXPECT_EQ(store_->counts().grasps, 5);
  EXPECT_EQ(store_->counts().done, 2);
}

TEST_P(StoreLaws, all_of_a_call_or_nothing) {
  store_->add_units({glass_, plane_});
  const StoreCounts before = store_->counts();
  UnitResult bad = done(plane_, 3, 2);
  bad.grasps[2].source = "nobody";
  expect_sentence(error_of([&] { store_->finish_units({done(glass_, 3, 1), bad}); }), {"source", "nobody"});
  UnitResult infinite = done(plane_, 3, 2);
  infinite.grasps[1].grasp.epsilon = std::nan("");
  expect_sentence(error_of([&] { store_->finish_units({done(glass_, 3, 1), infinite}); }), {"nan", "finite"});
  UnitResult stray = done(plane_, 1, 2);
  stray.grasps[0].grasp.object_scale = 1.0;
  expect_sentence(error_of([&] { store_->finish_unit(stray); }), {"1.25"});
  const auto unknown = error_of([&] { store_->add_units({small_glass_, {"cup", 1.0, "human"}}); });
  expect_sentence(unknown, {"no object 'cup'"});
  expect_sentence(error_of([&] {
                    store_->add_units({{"glass", 3.0, "human"}});
                  }),
                  {"glass", "not at scale 3"});
  expect_sentence(error_of([&] { store_->add_units({{"glass", 1.0, "claw"}}); }), {"no hand 'claw'"});
  EXPECT_EQ(store_->counts(), before);
  reopen();
  EXPECT_EQ(store_->counts(), before);
  EXPECT_TRUE(store_->grasps("glass", "human").empty());
}

TEST_P(StoreLaws, units_are_claimed_in_order_and_end_once) {
  EXPECT_EQ(store_->add_units({plane_, glass_, small_glass_, plane_}), 3u);
  EXPECT_EQ(store_->add_units({glass_}), 0u);
  EXPECT_TRUE(store_->claimed_units().empty());
  EXPECT_EQ(store_->claim_unit("a", 60.0), plane_);
  EXPECT_EQ(store_->claimed_units(), std::vector<StoredUnit>{store_->units().at(0)});
  EXPECT_EQ(store_->claim_unit("b", 60.0), glass_);
  EXPECT_TRUE(store_->finish_unit(done(plane_, 2, 1)));
  EXPECT_EQ(store_->claim_unit("a", 60.0), small_glass_);
  EXPECT_EQ(store_->claim_unit("a", 60.0), std::nullopt);
  EXPECT_TRUE(store_->finish_unit({small_glass_, UnitState::failed, "no grasp in 60 s", "a", 60.0, {}}));
  reopen();
  const auto units = store_->units();
  ASSERT_EQ(units.size(), 3u);
  EXPECT_EQ(units[0], (StoredUnit{plane_, UnitState::done, "", "worker 1", 0.0, 0.25}));
  EXPECT_EQ(units[1].state, UnitState::claimed);
  EXPECT_EQ(units[1].worker, "b");
  EXPECT_GT(units[1].lease_until, 1.6e9);
  EXPECT_EQ(units[2], (StoredUnit{small_glass_, UnitState::failed, "no grasp in 60 s", "a", 0.0, 60.0}));
  EXPECT_EQ(store_->claim_unit("a", 60.0), std::nullopt);  // a failure is not tried for ever
  EXPECT_EQ(store_->reopen_failed_units(), 1u);
  EXPECT_EQ(store_->claim_unit("a", 60.0), small_glass_);
}

TEST_P(StoreLaws, all_units_of_an_object_are_claimed_together) {
  const UnitKey barrett{glass_.object, glass_.scale, "barrett"};
  EXPECT_EQ(store_->add_units({glass_, plane_, small_glass_, barrett}), 4u);
  EXPECT_TRUE(store_->finish_unit(done(small_glass_, 1, 1)));
  EXPECT_EQ(store_->claim_object("a", 60.0), (std::vector<UnitKey>{glass_, barrett}));
  EXPECT_EQ(store_->claim_object("b", 60.0), std::vector<UnitKey>{plane_});
  EXPECT_TRUE(store_->claim_object("c", 60.0).empty());
  EXPECT_TRUE(store_->renew_lease(barrett, "a", -1.0));
  EXPECT_EQ(store_->claim_object("c", 60.0), std::vector<UnitKey>{barrett});
  EXPECT_EQ(store_->counts().claimed, 3);
}

TEST_P(StoreLaws, leases_end_are_renewed_and_given_back) {
  store_->add_units({glass_, plane_});
  ASSERT_EQ(store_->claim_unit("a", 0.15), glass_);
  ASSERT_EQ(store_->claim_unit("b", 60.0), plane_);
  EXPECT_EQ(store_->claim_unit("c", 60.0), std::nullopt);
  EXPECT_FALSE(store_->renew_lease(glass_, "c", 60.0));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(store_->claim_unit("c", 60.0), glass_);
  EXPECT_FALSE(store_->renew_lease(glass_, "a", 60.0));
  EXPECT_TRUE(store_->renew_lease(glass_, "c", -1.0));
  EXPECT_EQ(store_->claim_unit("d", 60.0), glass_);
  EXPECT_FALSE(store_->release_unit(glass_, "c"));
  EXPECT_TRUE(store_->release_unit(glass_, "d"));
  EXPECT_EQ(store_->units()[0], (StoredUnit{glass_, UnitState::waiting, "", "", 0.0, 0.0}));
  EXPECT_EQ(store_->claim_unit("c", 60.0), glass_);
  EXPECT_TRUE(store_->finish_unit(done(glass_, 1, 1)));  // worker 1: the first result counts, whoever has it
  EXPECT_FALSE(store_->finish_unit({glass_, UnitState::failed, "late", "c", 1.0, {}}));
}

TEST_P(StoreLaws, threads_claim_every_unit_once) {
  StoredModel many = store_->models()[1];
  many.name = "many";
  many.scales.clear();
  std::vector<UnitKey> keys;
  for (int i = 1; i <= 40; ++i) {
    many.scales.push_back(0.1 * i);
    keys.push_back({"many", 0.1 * i, "human"});
  }
  store_->add_model(many);
  ASSERT_EQ(store_->add_units(keys), 40u);
  const bool own_stores = std::string(GetParam()) != "text";  // one writer
  std::vector<std::vector<UnitKey>> got(4);
  std::vector<std::string> errors(4);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      errors[t] = error_of([&] {
        std::unique_ptr<GraspStore> own = own_stores ? open_store(address_) : nullptr;
        GraspStore& store = own ? *own : *store_;
        while (const auto key = store.claim_unit(fmt::format("thread {}", t), 60.0)) {
          got[t].push_back(*key);
          store.finish_unit(done(*key, 2, t));
        }
      });
    });
  for (std::thread& t : threads) t.join();
  std::multiset<UnitKey> all;
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_EQ(errors[t], "(no error)");
    all.insert(got[t].begin(), got[t].end());
  }
  EXPECT_EQ(all, std::multiset<UnitKey>(keys.begin(), keys.end()));
  EXPECT_EQ(store_->counts().done, 40);
  EXPECT_EQ(store_->counts().grasps, 80);
}

TEST_P(StoreLaws, grasps_without_a_unit_go_behind_the_others) {
  UnitResult unit = done(glass_, 2, 1);
  store_->finish_unit(unit);
  store_->add_source({"GraspIt!", "by hand"});
  const auto loose = RandomGrasps(9).grasps(glass_, stored_hand("human", 20), 3, "GraspIt!");
  store_->add_grasps(glass_, loose);
  unit.grasps.insert(unit.grasps.end(), loose.begin(), loose.end());
  expect_same(store_->grasps("glass", "human"), unit.grasps);
  store_->add_grasps(small_glass_, RandomGrasps(9).grasps(small_glass_, stored_hand("human", 20), 1));
  EXPECT_EQ(store_->units().size(), 1u);
  EXPECT_EQ(store_->add_units({small_glass_, glass_}), 1u);
  reopen();
  EXPECT_EQ(store_->claim_unit("a", 1.0), small_glass_);
  EXPECT_EQ(store_->counts().grasps, 6);
  EXPECT_EQ(store_->counts().grasps_by_hand,
            (std::vector<std::pair<std::string, std::int64_t>>{{"human", 6}, {"barrett", 0}}));
}

TEST_P(StoreLaws, neighbours_and_alignments_take_the_place_of_old_ones) {
  RandomGrasps random(6);
  StoredAlignment a{"glass", "psb_12", "pca", random.pose().matrix()};
  store_->set_alignments({a, {"psb_12", "glass", "pca", random.pose().matrix()}});
  store_->set_neighbors({{"glass", "psb_12", "zernike", 0.1}, {"psb_12", "glass", "zernike", 0.3}});
  a.X_target_model(0, 3) = -0.0;
  store_->set_alignments({a});
  store_->set_neighbors({{"glass", "psb_12", "zernike", 1.0 / 3.0}});
  expect_sentence(error_of([&] { store_->set_neighbors({{"glass", "cup", "zernike", 0.1}}); }), {"'cup'"});
  reopen();
  EXPECT_EQ(store_->neighbors(), (std::vector<StoredNeighbor>{{"glass", "psb_12", "zernike", 1.0 / 3.0},
                                                              {"psb_12", "glass", "zernike", 0.3}}));
  ASSERT_EQ(store_->alignments().size(), 2u);
  EXPECT_EQ(store_->alignments()[0], a);
  EXPECT_TRUE(std::signbit(store_->alignments()[0].X_target_model(0, 3)));
}

TEST_P(StoreLaws, descriptors_read_back_equal_and_take_the_place_of_old_ones) {
  const StoredDescriptor glass{
      "glass", "surface", "voxels", {0.1, -0.0, 1e-300}, 1.0 / 3.0, {0.0, 5e-324, 1.0 / 7.0}};
  StoredDescriptor plane{"psb_12", "surface", "voxels", {0.0, 0.0, 0.0}, 0.25, {1.0, 2.0}};
  const StoredDescriptor solid{"psb_12", "solid", "moments", {0.0, 0.0, 0.0}, 0.25, {3.0}};
  store_->set_descriptors({plane, glass});
  plane.route = "moments";
  plane.invariants = std::vector<double>(121, 0.1);
  store_->set_descriptors({solid, plane});
  StoredDescriptor bad = plane;
  bad.invariants[7] = std::numeric_limits<double>::quiet_NaN();
  expect_sentence(error_of([&] {
                    store_->set_descriptors({glass, bad});
                  }),
                  {"invariant", "psb_12", "finite"});
  bad = plane;
  bad.radius = 0.0;
  expect_sentence(error_of([&] { store_->set_descriptors({bad}); }), {"radius", "more than 0"});
  bad = plane;
  bad.model = "cup";
  expect_sentence(error_of([&] { store_->set_descriptors({bad}); }), {"'cup'"});
  reopen();
  EXPECT_EQ(store_->descriptors(""), (std::vector<StoredDescriptor>{plane, glass, solid}));
  EXPECT_TRUE(std::signbit(store_->descriptors("")[1].center.y()));
  EXPECT_EQ(store_->descriptors("solid"), (std::vector<StoredDescriptor>{solid}));
  EXPECT_TRUE(store_->descriptors("volume").empty());
  EXPECT_EQ(store_->described("surface"), (std::vector<std::string>{"psb_12", "glass"}));
  EXPECT_TRUE(store_->described("volume").empty());
  EXPECT_EQ(store_->counts().descriptors, 3);
}

TEST_P(StoreLaws, a_store_that_is_updated_is_not_made) {
  store_.reset();
  EXPECT_TRUE(open_store(address_, {.access = StoreAccess::update})->add_source({"more", ""}));
  const std::string none = new_address(GetParam());
  EXPECT_NE(error_of([&] { open_store(none, {.access = StoreAccess::update}); }), "(no error)");
  EXPECT_NE(error_of([&] { open_store(none, {.access = StoreAccess::read}); }), "(no error)");
}

TEST_P(StoreLaws, a_store_that_is_read_is_not_changed) {
  store_->finish_unit(done(glass_, 2, 1));
  const auto expected = store_->grasps("glass", "human");
  store_.reset();
  const auto reader = open_store(address_, {.access = StoreAccess::read});
  expect_same(reader->grasps("glass", "human"), expected);
  EXPECT_EQ(reader->counts().grasps, 2);
  EXPECT_NE(error_of([&] { reader->add_source({"other", ""}); }), "(no error)");
  EXPECT_EQ(reader->sources().size(), 1u);
}

}  // namespace
}  // namespace eigengrasp
