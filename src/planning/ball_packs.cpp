// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/ball_packs.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace eigengrasp {

namespace {

using kernel::n_lanes;
constexpr std::size_t of_pack = n_lanes;   // balls of a pack
constexpr std::size_t most_of_core = 256;  // balls that a core owns, at most 16 packs
constexpr float never = -1e9f;             // radius of a ball that meets nothing
constexpr double field_slack = 0.0003;     // [m] for the field's error at a centre

using Balls = std::span<Sphere>;

void sort_along_longest_side(Balls balls) {
  Box centers;
  for (const Sphere& s : balls) centers.add(s.center);
  Eigen::Index axis = 0;
  centers.size().maxCoeff(&axis);
  std::stable_sort(balls.begin(), balls.end(),
                   [axis](const Sphere& a, const Sphere& b) { return a.center[axis] < b.center[axis]; });
}

/// Orders balls so that neighbours stand together and cuts them into groups of at most so many, by halving;
/// all packs but the last one of a group are full.
void cut(Balls balls, std::size_t most, std::vector<Balls>& groups) {
  if (balls.size() <= most) {
    groups.push_back(balls);
    return;
  }
  sort_along_longest_side(balls);
  const std::size_t packs = (balls.size() + of_pack - 1) / of_pack;
  const std::size_t half = packs / 2 * of_pack;
  cut(balls.first(half), most, groups);
  cut(balls.subspan(half), most, groups);
}

kernel::BallPack pack_of(Balls balls) {
  kernel::BallPack pack{};
  std::fill(std::begin(pack.radius), std::end(pack.radius), never);
  for (std::size_t k = 0; k < balls.size(); ++k) {
    pack.x[k] = static_cast<float>(balls[k].center.x());
    pack.y[k] = static_cast<float>(balls[k].center.y());
    pack.z[k] = static_cast<float>(balls[k].center.z());
    pack.radius[k] = static_cast<float>(balls[k].radius);
  }
  return pack;
}

template <class Pack>
Pack pack_of_none() {
  Pack pack{};
  std::fill(std::begin(pack.radius), std::end(pack.radius), never);
  std::fill(std::begin(pack.reach), std::end(pack.reach), never);
  return pack;
}

double reach_from(const Sphere& core, Balls balls) {
  double reach = 0.0;
  for (const Sphere& s : balls) reach = std::max(reach, (s.center - core.center).norm() + s.radius);
  return reach;
}

/// The ball over whose surface the others stick out least.
const Sphere& core_of(Balls balls) {
  const Sphere* core = &balls.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& s : balls)
    if (const double excess = reach_from(s, balls) - s.radius; excess < least) {
      least = excess;
      core = &s;
    }
  return *core;
}

kernel::ClusterPack clusters_of(const std::vector<Balls>& packs) {
  auto clusters = pack_of_none<kernel::ClusterPack>();
  for (std::size_t k = 0; k < packs.size(); ++k) {
    const Sphere& core = core_of(packs[k]);
    clusters.x[k] = static_cast<float>(core.center.x());
    clusters.y[k] = static_cast<float>(core.center.y());
    clusters.z[k] = static_cast<float>(core.center.z());
    clusters.radius[k] = static_cast<float>(core.radius);
    clusters.reach[k] = static_cast<float>(reach_from(core, packs[k]) + field_slack);
  }
  return clusters;
}

}  // namespace

void BallPacks::add(std::vector<Sphere> balls_B, kernel::Part& part) {
  std::vector<Balls> owned;
  if (!balls_B.empty()) cut(balls_B, most_of_core, owned);
  part.first_core = n_cores();
  part.n_cores = static_cast<int>(owned.size());
  for (const Balls& balls : owned) {
    std::vector<Balls> packs;
    cut(balls, of_pack, packs);
    clusters_.push_back(clusters_of(packs));
    packs.resize(n_lanes);
    for (const Balls& pack : packs) balls_.push_back(pack_of(pack));
    const Sphere& core = core_of(balls);
    add_core(core, reach_from(core, balls) + field_slack, part.body);
  }
}

void BallPacks::add_core(const Sphere& core, double reach, int body) {
  const std::size_t lane = cores_.size() % n_lanes;
  if (lane == 0) core_packs_.push_back(pack_of_none<kernel::CorePack>());
  kernel::CorePack& pack = core_packs_.back();
  pack.place[lane] = 3 * n_lanes * n_cores();
  pack.radius[lane] = static_cast<float>(core.radius);
  pack.reach[lane] = static_cast<float>(reach);
  kernel::CoreBall ball{};
  for (int i = 0; i < 3; ++i) ball.center[i] = static_cast<float>(core.center[i]);
  ball.body = body;
  cores_.push_back(ball);
}

}  // namespace eigengrasp
