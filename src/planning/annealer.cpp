// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/annealer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/search_areas.hpp"
#include "eigengrasp/planning/temperature_ladder.hpp"
#include "planning/chain_bests.hpp"
#include "planning/kernel_workspace.hpp"
#include "planning/lane_state.hpp"

namespace eigengrasp {

double AnnealingSchedule::temperature(double progress) const {
  const double k = first_k + progress * (last_k - first_k);
  return initial_temperature * std::exp(-decay * std::pow(k, 1.0 / dimensions));
}

SearchSpace::SearchSpace(const Scene& scene, int n_amplitudes)
    : postures(
          scene.hand->eigengrasps.with_size(n_amplitudes, scene.hand->dof_min(), scene.hand->dof_max())) {
  const Box box = bounding_box(scene.object->mesh);
  center_O = box.center();
  // The approach point lies in front of the palm: farther than this from the object no contact is near.
  half_range = 0.5 * box.size() + Vec3::Constant(0.5 * hand_reach(*scene.hand));
}

Pose hand_pose(const HandModel& hand, const HandState& state) {
  return make_pose(state.q_OA, state.p_OA) * Eigen::Translation3d(-hand.approach_point_H);
}

VecX hand_posture(const HandModel& hand, const SearchSpace& space, const HandState& state) {
  return clamp_posture(hand, space.postures.embed(state.amplitudes));
}

namespace {

constexpr int n_lanes = kernel::n_lanes;
constexpr int steps_between_exchanges = 2;
constexpr int all_expansions = 0;  ///< of the polytope: eq. (8) is exact where it counts
constexpr float no_energy = 1e8f;  ///< of a start: the first legal neighbour is taken

kernel::SearchBox search_box(const SearchSpace& space, std::vector<kernel::Range>& ranges) {
  for (int i = 0; i < space.postures.size(); ++i) {
    const Eigengrasp& e = space.postures[i];
    ranges.push_back({static_cast<float>(e.min), static_cast<float>(e.max),
                      static_cast<float>(space.max_amplitude_jump * (e.max - e.min))});
  }
  kernel::SearchBox box{};
  for (int i = 0; i < 3; ++i) {
    box.low[i] = static_cast<float>(space.center_O[i] - space.half_range[i]);
    box.high[i] = static_cast<float>(space.center_O[i] + space.half_range[i]);
  }
  box.max_shift = static_cast<float>(space.max_shift);
  box.max_turn = static_cast<float>(space.max_turn);
  box.n_amplitudes = space.postures.size();
  box.amplitudes = ranges.data();
  return box;
}

}  // namespace

struct Annealer::Lanes {
  Lanes(const Task& task, const Distinctness& distinctness)
      : batch(task.evaluator),
        memory(task.space.postures.size()),
        bests(task.space.postures, distinctness),
        box(search_box(task.space, ranges)) {}

  void raise_ladder(const Task& task, std::uint64_t number) {
    std::vector<double> acceptance;
    for (int rung = 0; rung < n_lanes; ++rung) {
      const double progress = 1.0 - rung / (n_lanes - 1.0);
      jump_temperatures.push_back(task.schedule.temperature(progress));
      acceptance.push_back(task.schedule.acceptance_temperature(progress));
    }
    constexpr std::uint64_t exchanges = 1;  // the annealer's own stream has a key of two numbers
    ladder.emplace(std::move(acceptance), RandomStream{task.seed, number, exchanges});
  }

  StateRows proposals() const {
    const kernel::Workspace& work = batch.memory_->work();
    return {work.position, work.quaternion, work.amplitudes};
  }
  StateRows current() const {
    const kernel::Chains& chains = memory.chains();
    return {chains.position, chains.quaternion, chains.amplitudes};
  }

  StateEvaluator::Batch batch;
  KernelChains memory;
  ChainBests bests;
  std::vector<kernel::Range> ranges;
  kernel::SearchBox box;
  std::optional<TemperatureLadder> ladder;  ///< of acceptance
  std::vector<double> jump_temperatures;    ///< of its rungs
  int steps = 0;                            ///< on it
  std::vector<ContactApproach> approaches;
  std::vector<Pose> X_OL;
  std::array<WeakDirections, n_lanes> weak;  ///< of each chain
};

Annealer::Annealer(const Task& task, std::uint64_t number, int n_chains, PreGraspList list)
    : task_(task),
      n_chains_(n_chains),
      number_(static_cast<int>(number)),
      list_(std::move(list)),
      random_({task.seed, number}),
      lanes_(std::make_unique<Lanes>(task, list_.distinctness())) {
  for (int i = 0; i < 4 * n_lanes; ++i)
    lanes_->memory.chains().random[i] = static_cast<std::int32_t>(random_() >> 32);
  if (task.tempered) lanes_->raise_ladder(task, number);
  restart();
}

Annealer::~Annealer() = default;
Annealer::Annealer(Annealer&&) noexcept = default;

void Annealer::restart() {
  if (lanes_->ladder) lanes_->ladder->reset();
  for (int c = 0; c < n_chains_; ++c) restart(c, random_state());
}

void Annealer::restart(int chain, const HandState& state) {
  const int each = n_lanes / n_chains_;
  for (int lane = chain * each; lane < (chain + 1) * each; ++lane) {
    put_lane(state, lane, lanes_->current());
    lanes_->memory.chains().energy[lane] = no_energy;
  }
}

HandState Annealer::random_state() {
  const SearchSpace& space = task_.space;
  HandState s;
  for (Eigen::Index i = 0; i < 3; ++i)
    s.p_OA[i] = space.center_O[i] + space.half_range[i] * random_.uniform(-1.0, 1.0);
  s.q_OA.coeffs() = Eigen::Vector4d(random_.normal(), random_.normal(), random_.normal(), random_.normal());
  s.q_OA.normalize();
  s.amplitudes = VecX::Zero(space.postures.size());
  return s;
}

void Annealer::set_temperatures(double progress) {
  const kernel::Chains& chains = lanes_->memory.chains();
  const double t = task_.schedule.temperature(progress);
  std::fill_n(chains.jump_temperature, n_lanes, static_cast<float>(t));
  std::fill_n(chains.log_range, n_lanes, static_cast<float>(std::log1p(1.0 / t)));
  std::fill_n(chains.acceptance_temperature, n_lanes,
              static_cast<float>(task_.schedule.acceptance_temperature(progress)));
}

/// Each lane at the temperature of its chain, after chains have traded theirs.
void Annealer::temper() {
  const kernel::Chains& chains = lanes_->memory.chains();
  TemperatureLadder& ladder = *lanes_->ladder;
  if (++lanes_->steps % steps_between_exchanges == 0) ladder.exchange(chains.energy);
  for (int chain = 0; chain < n_lanes; ++chain) {
    const double t = lanes_->jump_temperatures[static_cast<std::size_t>(ladder.rung(chain))];
    chains.jump_temperature[chain] = static_cast<float>(t);
    chains.log_range[chain] = static_cast<float>(std::log1p(1.0 / t));
    chains.acceptance_temperature[chain] = static_cast<float>(ladder.temperature(chain));
  }
}

void Annealer::step(double progress, std::int64_t most) {
  const kernel::Workspace& work = lanes_->batch.memory_->work();
  const kernel::Chains& chains = lanes_->memory.chains();
  if (lanes_->ladder) {
    temper();
  } else {
    set_temperatures(progress);
  }
  task_.evaluator.functions_->propose(lanes_->box, chains, work);
  if (task_.judge_all || task_.energy.kind() == EnergyKind::wrench) {
    judge_in_full();
  } else {
    task_.evaluator.evaluate(lanes_->batch);
  }
  const int each = n_lanes / n_chains_;
  for (int first = 0; first < n_lanes; first += each)
    for (int lane = first; lane < first + each && most > 0; ++lane) {
      const auto verdict = lanes_->batch.verdict(lane);
      count(verdict);
      --most;
      if (verdict != StateEvaluator::Verdict::legal) continue;
      if (task_.avoided != nullptr && task_.avoided->holds(lanes_->batch.state(lane))) continue;
      for (int k = first; k < first + each; ++k) {
        copy_lane(lanes_->proposals(), lane, lanes_->current(), k, task_.space.postures.size());
        chains.energy[k] = work.energy[lane];
      }
      remember(lane, first / each);
      break;
    }
}

/// Legality of all states in lanes; then the energy of eq. (8) one by one where that is asked for; thresholds
/// last.
void Annealer::judge_in_full() {
  const HandModel& hand = *task_.model.scene().hand;
  const kernel::Workspace& work = lanes_->batch.memory_->work();
  float thresholds[n_lanes];
  std::copy_n(work.threshold, n_lanes, thresholds);
  std::fill_n(work.threshold, n_lanes, std::numeric_limits<float>::infinity());
  task_.evaluator.evaluate(lanes_->batch);
  for (int lane = 0; lane < n_lanes; ++lane) {
    if (lanes_->batch.verdict(lane) != StateEvaluator::Verdict::legal) continue;
    if (task_.energy.kind() == EnergyKind::wrench) {
      const HandState state = lanes_->batch.state(lane);
      const VecX joints = joint_values(hand, hand_posture(hand, task_.space, state));
      compute_link_poses(hand, joints, hand_pose(hand, state), lanes_->X_OL);
      task_.energy.approach(lanes_->X_OL, DistanceSource::field, lanes_->approaches);
      WeakDirections& weak = lanes_->weak[static_cast<std::size_t>(lane * n_chains_ / n_lanes)];
      work.energy[lane] = static_cast<float>(task_.energy.wrench_energy(
          lanes_->approaches, static_cast<double>(thresholds[lane]), weak, all_expansions));
    }
    if (!(work.energy[lane] < thresholds[lane])) work.verdict[lane] = kernel::energy_too_high;
  }
}

void Annealer::count(StateEvaluator::Verdict verdict) {
  ++counts_.evaluated;
  switch (verdict) {
    case StateEvaluator::Verdict::hits_object:
      ++counts_.hit_object;
      break;
    case StateEvaluator::Verdict::hits_itself:
      ++counts_.hit_itself;
      break;
    case StateEvaluator::Verdict::hits_obstacle:
      ++counts_.hit_obstacle;
      break;
    case StateEvaluator::Verdict::legal:
    case StateEvaluator::Verdict::energy_too_high:
      ++counts_.legal;
      break;
  }
}

void Annealer::remember(int lane, int chain) {
  const float energy = lanes_->batch.memory_->work().energy[lane];
  if (energy < best_energy_) {
    best_energy_ = energy;
    const PreGrasp found = pregrasp(lanes_->batch.state(lane), energy, chain, counts_.evaluated);
    milestones_.push_back({counts_.evaluated, best_energy_, found.X_OH, found.dofs});
  }
  ChainBests& bests = lanes_->bests;
  if (bests.holds(chain)) {
    const bool near = bests.near(chain, lanes_->proposals(), lane);
    if (near && bests.energy(chain) <= energy) return;
    if (!near) settle(chain);
  }
  bests.hold(chain, lanes_->proposals(), lane, energy, counts_.evaluated);
}

PreGrasp Annealer::pregrasp(const HandState& state, double energy, int chain, std::int64_t iteration) const {
  const HandModel& hand = *task_.model.scene().hand;
  return {hand_pose(hand, state),    state.amplitudes, hand_posture(hand, task_.space, state), energy,
          number_ * n_lanes + chain, iteration};
}

/// Offers the list what is held of a chain.
void Annealer::settle(int chain) {
  ChainBests& bests = lanes_->bests;
  const double energy = bests.energy(chain);
  if (list_.admits(energy)) list_.add(pregrasp(bests.state(chain), energy, chain, bests.iteration(chain)));
  bests.drop(chain);
}

const PreGraspList& Annealer::best() {
  for (int chain = 0; chain < n_chains_; ++chain)
    if (lanes_->bests.holds(chain)) settle(chain);
  return list_;
}

void Annealer::forget() {
  for (int chain = 0; chain < n_chains_; ++chain) lanes_->bests.drop(chain);
  list_.clear();
}

}  // namespace eigengrasp
