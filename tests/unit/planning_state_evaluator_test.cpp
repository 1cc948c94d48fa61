// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Sixteen states at once: the same bits with all instruction sets, and what independent scalar code says.
#include "eigengrasp/planning/state_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "support/parallel_gripper.hpp"
#include "support/shipped_scenes.hpp"
#include "support/state_walk.hpp"

namespace eigengrasp {
namespace {

using testing::any_neighbor;
using testing::any_state;
using testing::at;
using testing::box_mesh;
using testing::scene_of;
using testing::solid;
using Verdict = StateEvaluator::Verdict;

constexpr double alpha = 0.05;

std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

CollisionModel fast_model(Scene scene) {
  CollisionModel::Options options;
  options.threads = 2;
  return CollisionModel(std::move(scene), options);
}

/// Random states, and the neighbours of a walk, most of them near contact.
std::vector<HandState> mixed_states(const SearchSpace& space, const StateEvaluator& evaluator, int n_random,
                                    int n_steps) {
  RandomStream random{11};
  std::vector<HandState> states;
  for (int i = 0; i < n_random; ++i) states.push_back(any_state(space, random));
  testing::SeenWalk(space, evaluator, 3).anneal({}, n_steps, [&](const StateEvaluator::Batch& batch) {
    for (int lane = 0; lane < StateEvaluator::lanes; ++lane) states.push_back(batch.state(lane));
  });
  return states;
}

struct Outcome {
  Verdict verdict;
  double energy;
};

std::vector<Outcome> evaluate_all(const StateEvaluator& evaluator, const std::vector<HandState>& states,
                                  double threshold = std::numeric_limits<double>::infinity()) {
  constexpr std::size_t n = StateEvaluator::lanes;
  StateEvaluator::Batch batch(evaluator);
  for (int k = 0; k < StateEvaluator::lanes; ++k) batch.set_threshold(k, threshold);
  std::vector<Outcome> outcomes;
  for (std::size_t first = 0; first < states.size(); first += n) {
    const std::size_t count = std::min(n, states.size() - first);
    for (std::size_t k = 0; k < count; ++k) batch.set(static_cast<int>(k), states[first + k]);
    evaluator.evaluate(batch);
    for (int k = 0; k < static_cast<int>(count); ++k) outcomes.push_back({batch.verdict(k), batch.energy(k)});
  }
  return outcomes;
}

void expect_same_bits(const std::vector<Outcome>& a, const std::vector<Outcome>& b) {
  ASSERT_EQ(a.size(), b.size());
  int different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different += a[i].verdict != b[i].verdict || bits_of(a[i].energy) != bits_of(b[i].energy);
  EXPECT_EQ(different, 0) << "of " << a.size();
}

void expect_sets_agree(const CollisionModel& model, int n_amplitudes, int n_random, int n_steps) {
  SCOPED_TRACE(model.scene().hand->name + ", amplitudes " + std::to_string(n_amplitudes));
  const SearchSpace space(model.scene(), n_amplitudes);
  const StateEvaluator baseline(model, space.postures, alpha, InstructionSet::baseline);
  const auto states = mixed_states(space, baseline, n_random, n_steps);
  const auto all = evaluate_all(baseline, states);
  const auto good = evaluate_all(baseline, states, 40.0);
  EXPECT_GT(
      std::count_if(all.begin(), all.end(), [](const Outcome& o) { return o.verdict == Verdict::legal; }),
      static_cast<std::ptrdiff_t>(all.size() / 10));
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(name_of(set));
    const StateEvaluator evaluator(model, space.postures, alpha, set);
    expect_same_bits(evaluate_all(evaluator, states), all);
    expect_same_bits(evaluate_all(evaluator, states, 40.0), good);
  }
}

TEST(StateEvaluatorSets, AgreeForEveryNumberOfAmplitudes) {
  const CollisionModel model = fast_model(testing::shipped_scene("human", "glass"));
  const int n_dof = model.scene().hand->n_dof();
  for (const int n : {0, 1, 2, 3, n_dof}) expect_sets_agree(model, n, 800, 150);
}

TEST(StateEvaluatorSets, AgreeForAHandOfMetalAndAScaledShoe) {
  expect_sets_agree(fast_model(testing::shipped_scene("barrett-metal", "shoe", 1.5)), 2, 1600, 200);
}

TEST(StateEvaluatorSets, AgreeWithATable) {
  Scene scene = testing::shipped_scene("robonaut", "glass");
  scene.obstacles.push_back(make_table(bounding_box(scene.object->mesh).min.z()));
  expect_sets_agree(fast_model(scene), 2, 1600, 200);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

// The field's rounding to sixteen bits sets the two apart where its gradient is good at all contacts:
// distances by half a quantum, which is 0.006 mm for the 0.4 m of the coarse grid, directions by as much over
// a cell of 2 mm, times alpha. Elsewhere GraspEnergy asks the mesh.
TEST(StateEvaluator, PosesAndEnergyVsDoublePrecision) {
  for (const char* hand : {"human", "barrett-metal"}) {
    const CollisionModel model = fast_model(testing::shipped_scene(hand, "shoe"));
    const SearchSpace space(model.scene(), 3);
    const StateEvaluator evaluator(model, space.postures, alpha);
    const GraspEnergy energy(model, {});
    const auto states = mixed_states(space, evaluator, 1000, 150);
    const auto outcomes = evaluate_all(evaluator, states);
    std::vector<double> residuals, good;
    std::vector<ContactApproach> approaches;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (outcomes[i].verdict != Verdict::legal) continue;
      const auto X_OL = testing::link_poses(*model.scene().hand, space, states[i]);
      energy.approach(X_OL, DistanceSource::field, approaches);
      const bool all_good = std::all_of(approaches.begin(), approaches.end(), [&](const ContactApproach& a) {
        return model.object_field().covers(a.p_OC) &&
               model.object_field().sample(a.p_OC).gradient.norm() > 0.975;
      });
      residuals.push_back(std::abs(energy.contact_energy(approaches) - outcomes[i].energy));
      if (all_good) good.push_back(residuals.back());
    }
    ASSERT_GT(good.size(), 100u);
    std::sort(good.begin(), good.end());
    std::cout << hand << ": " << good.size() << " of " << residuals.size()
              << " states with good gradients, median " << median(good) << ", largest " << good.back()
              << " mm; all: median " << median(residuals) << "\n";
    EXPECT_LT(median(good), 0.006);
    EXPECT_LT(good.back(), 0.03);
    EXPECT_LT(median(residuals), 0.006);
  }
}

TEST(StateEvaluator, KeptApproachesAreThoseOfThePosedHandAndMakeTheEnergy) {
  const CollisionModel model = fast_model(testing::shipped_scene("human", "shoe"));
  const SearchSpace space(model.scene(), 2);
  const StateEvaluator evaluator(model, space.postures, alpha);
  const GraspEnergy energy(model, {});
  const auto states = mixed_states(space, evaluator, 320, 20);
  StateEvaluator::Batch batch(evaluator);
  batch.keep_approaches();
  std::vector<ContactApproach> kept, posed;
  int legal = 0;
  for (std::size_t first = 0; first + StateEvaluator::lanes <= states.size();
       first += StateEvaluator::lanes) {
    for (int k = 0; k < StateEvaluator::lanes; ++k) batch.set(k, states[first + static_cast<std::size_t>(k)]);
    evaluator.evaluate(batch);
    for (int k = 0; k < StateEvaluator::lanes; ++k) {
      if (batch.verdict(k) != Verdict::legal) continue;
      ++legal;
      batch.approaches(k, kept);
      EXPECT_NEAR(energy.contact_energy(kept), batch.energy(k), 1e-4 * (1.0 + batch.energy(k)));
      const auto X_OL =
          testing::link_poses(*model.scene().hand, space, states[first + static_cast<std::size_t>(k)]);
      energy.approach(X_OL, DistanceSource::gradients, posed);
      ASSERT_EQ(kept.size(), posed.size());
      for (std::size_t i = 0; i < kept.size(); ++i) {
        EXPECT_LT((kept[i].p_OC - posed[i].p_OC).norm(), 1e-6);
        EXPECT_LT((kept[i].n_OC - posed[i].n_OC).norm(), 1e-5);
      }
    }
  }
  EXPECT_GT(legal, 100);
}

/// Verdict of one posed hand, all degrees of freedom amplitudes.
class Judge {
 public:
  explicit Judge(Scene scene) : model_(fast_model(std::move(scene))), space_(model_.scene(), 0) {
    const HandModel& hand = *model_.scene().hand;
    if (hand.n_dof() > 0)
      space_.postures = EigengraspSpace::identity(VecX::Zero(hand.n_dof()), hand.dof_min(), hand.dof_max(),
                                                  hand.dof_names());
    evaluator_ = std::make_unique<StateEvaluator>(model_, space_.postures, alpha);
  }
  Verdict operator()(const Pose& X_OH, const VecX& dofs = {}) const {
    const HandState state{X_OH * model_.scene().hand->approach_point_H, Eigen::Quaterniond(X_OH.linear()),
                          dofs};
    return evaluate_all(*evaluator_, {state})[0].verdict;
  }
  const CollisionModel& model() const { return model_; }

 private:
  CollisionModel model_;
  SearchSpace space_;
  std::unique_ptr<StateEvaluator> evaluator_;
};

/// A hand without joints, with an empty space of postures over no degrees of freedom.
std::shared_ptr<HandModel> rigid(TriangleMesh mesh) {
  auto hand = testing::pad(std::move(mesh));
  hand->eigengrasps = EigengraspSpace(VecX(0), {});
  return hand;
}

TEST(StateEvaluator, FingersOnABoxAreLegalUntilTheyEnterIt) {
  const Judge judge(
      scene_of(testing::parallel_gripper(), solid(box_mesh({0.04, 0.04, 0.04}), {0.0, 0.0, 0.03})));
  for (const double q : {0.0, 0.020, 0.0240})
    EXPECT_EQ(judge(Pose::Identity(), VecX::Constant(1, q)), Verdict::legal) << q;
  for (const double q : {0.0262, 0.030, 0.040})
    EXPECT_EQ(judge(Pose::Identity(), VecX::Constant(1, q)), Verdict::hits_object) << q;
}

TEST(StateEvaluator, FingersMeetEachOther) {
  const Judge judge(
      scene_of(testing::parallel_gripper(DofType::rigid, 0.06), solid(box_mesh({0.04, 0.04, 0.04}))));
  const Pose away = at(0.0, 0.0, 0.3);
  EXPECT_EQ(judge(away, VecX::Constant(1, 0.0440)), Verdict::legal);
  EXPECT_EQ(judge(away, VecX::Constant(1, 0.0458)), Verdict::hits_itself);
  EXPECT_EQ(judge(away, VecX::Constant(1, 0.0470)), Verdict::hits_itself);
}

TEST(StateEvaluator, TheTableIsAnObstacle) {
  const Judge judge(scene_of(testing::parallel_gripper(),
                             solid(box_mesh({0.04, 0.04, 0.04}), {0.0, 0.0, 0.03}), {make_table(0.01)}));
  Pose from_above = make_pose(Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.075});
  EXPECT_EQ(judge(from_above, VecX::Zero(1)), Verdict::legal);
  from_above.translation().z() = 0.0690;  // tips at 8 mm
  EXPECT_EQ(judge(from_above, VecX::Zero(1)), Verdict::hits_obstacle);
}

TEST(StateEvaluator, OneInsideTheOtherCollides) {
  const Judge small_hand(scene_of(rigid(testing::ball_mesh(0.01, 12)), solid(box_mesh({0.1, 0.1, 0.1}))));
  EXPECT_EQ(small_hand(at(0.005, 0.0, 0.0)), Verdict::hits_object);
  const Judge small_object(scene_of(rigid(box_mesh({0.1, 0.1, 0.1})), solid(testing::ball_mesh(0.01, 12))));
  EXPECT_EQ(small_object(at(0.005, 0.0, 0.0)), Verdict::hits_object);
}

// A wall thinner than the cells of its field, closed or a soup of triangles without shared vertices.
TEST(StateEvaluator, AThinWallThroughAFingerCollides) {
  const TriangleMesh wall = box_mesh({0.1, 0.0012, 0.1});
  TriangleMesh soup;
  for (std::size_t t = 0; t < wall.triangles.size(); ++t) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(wall.corner(t, k));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  for (const TriangleMesh& mesh : {wall, soup}) {
    const Judge judge(scene_of(rigid(box_mesh({0.01, 0.02, 0.06})), solid(mesh)));
    for (const double y : {0.0, 0.003, -0.007, 0.0085})
      EXPECT_EQ(judge(at(0.01, y, 0.02)), Verdict::hits_object) << y;
    for (const double y : {0.0125, -0.02, 0.1}) EXPECT_EQ(judge(at(0.01, y, 0.02)), Verdict::legal) << y;
  }
}

TEST(StateEvaluator, FarOutsideOfTheGridsAllIsLegalAndTheEnergyIsTheDistance) {
  auto hand = rigid(box_mesh({0.01, 0.01, 0.01}));
  hand->virtual_contacts.push_back({0, Vec3(0.0, 0.0, -0.005), Vec3(0.0, 0.0, -1.0)});
  const CollisionModel model = fast_model(scene_of(hand, solid(box_mesh({0.06, 0.06, 0.06}))));
  const StateEvaluator evaluator(model, hand->eigengrasps, alpha);
  for (const double height : {0.2, 0.5, 2.0, 100.0}) {
    const auto outcome =
        evaluate_all(evaluator, {{Vec3(0.0, 0.0, height), Eigen::Quaterniond::Identity(), VecX(0)}})[0];
    EXPECT_EQ(outcome.verdict, Verdict::legal);
    EXPECT_NEAR(outcome.energy, 1000.0 * (height - 0.035), 0.02 * 1000.0 * height);
  }
}

// check_fast has spheres against spheres for links, where the evaluator has a field: only the object counts.
TEST(StateEvaluator, LegalityVsMeshesAndScalarCode) {
  const CollisionModel model =
      fast_model(scene_of(testing::two_finger_hand(), solid(testing::torus_mesh(0.03, 0.012))));
  const SearchSpace space(model.scene(), 2);
  const StateEvaluator evaluator(model, space.postures, alpha);
  const auto states = mixed_states(space, evaluator, 1500, 100);
  const auto outcomes = evaluate_all(evaluator, states);
  int legal = 0, refused = 0, illegal = 0, unlike_scalar = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto X_OL = testing::link_poses(*model.scene().hand, space, states[i]);
    const bool exact = model.check_exact(X_OL) == Legality::legal;
    const bool fast = outcomes[i].verdict == Verdict::legal;
    unlike_scalar += fast != (model.check_fast(X_OL) == Legality::legal);
    legal += exact;
    illegal += !exact;
    refused += exact && !fast;
    if (fast && !exact) {
      EXPECT_LT(model.deepest_penetration(X_OL), 0.001) << i;
    }
  }
  EXPECT_GT(legal, 500);
  EXPECT_GT(illegal, 500);
  EXPECT_LE(refused, legal / 50);
  EXPECT_LE(unlike_scalar, static_cast<int>(states.size() / 100));
}

// A third amplitude that stays 0 gives the same postures without a grid.
TEST(StateEvaluator, TheGridOfPosturesVsThePairsThemselves) {
  for (const char* name : {"human", "barrett-metal", "robonaut"}) {
    const CollisionModel model = fast_model(testing::shipped_scene(name, "glass"));
    const HandModel& hand = *model.scene().hand;
    const SearchSpace two(model.scene(), 2);
    const SearchSpace three(model.scene(), 3);
    const StateEvaluator with_grid(model, two.postures, alpha);
    const StateEvaluator without(model, three.postures, alpha);
    RandomStream random{7};
    std::vector<HandState> states, wider;
    for (int i = 0; i < 6000; ++i) {
      HandState s = any_state(two, random);
      s.p_OA = Vec3(1.0, 1.0, 1.0);  // far from the object
      states.push_back(s);
      s.amplitudes.conservativeResize(3);
      s.amplitudes[2] = 0.0;
      wider.push_back(s);
    }
    const auto a = evaluate_all(with_grid, states);
    const auto b = evaluate_all(without, wider);
    int collisions = 0, missed = 0, false_alarms = 0;
    double deepest = 0.0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      collisions += b[i].verdict == Verdict::hits_itself;
      missed += a[i].verdict == Verdict::legal && b[i].verdict != Verdict::legal;
      if (a[i].verdict == b[i].verdict) continue;
      const auto X_OL = testing::link_poses(hand, two, states[i]);
      if (a[i].verdict == Verdict::legal) {
        deepest = std::max(deepest, model.deepest_penetration(X_OL));
        continue;
      }
      ++false_alarms;
      double clearance = 1.0;
      for (const auto& pair : hand.collision_pairs)
        clearance = std::min(clearance, model.distance_of_links(pair[0], pair[1], X_OL, 0.01));
      EXPECT_LT(clearance, 0.001) << name << " " << states[i].amplitudes.transpose();
    }
    std::cout << name << ": " << collisions << " of " << states.size() << " postures collide, " << missed
              << " missed, deepest " << 1000.0 * deepest << " mm, " << false_alarms << " false alarms\n";
    EXPECT_LT(deepest, 0.001) << name;
  }
}

}  // namespace
}  // namespace eigengrasp
