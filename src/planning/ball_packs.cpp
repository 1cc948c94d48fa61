// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/ball_packs.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace eigengrasp {

namespace {

using kernel::n_lanes;
constexpr std::size_t of_pack = n_lanes;               // balls of a pack, one cluster
constexpr std::size_t of_clusters = n_lanes * of_pack;  // balls of a pack of clusters
constexpr float never = -1e9f;                         // radius of a ball that meets nothing
constexpr double cluster_slack = 0.0003;               // [m] for the field's error at a cluster's centre
constexpr int most_without_top = 1;                    // packs of clusters that are all looked at

using Balls = std::span<Sphere>;

/// Orders balls so that neighbours stand together, by halving along the longest side at a multiple of the
/// unit: every unit but the last is full.
void order(Balls balls, std::size_t unit) {
  if (balls.size() <= unit) return;
  Box centers;
  for (const Sphere& s : balls) centers.add(s.center);
  Eigen::Index axis = 0;
  centers.size().maxCoeff(&axis);
  std::stable_sort(balls.begin(), balls.end(),
                   [axis](const Sphere& a, const Sphere& b) { return a.center[axis] < b.center[axis]; });
  const std::size_t units = (balls.size() + unit - 1) / unit;
  const std::size_t half = units / 2 * unit;
  order(balls.first(half), unit);
  order(balls.subspan(half), unit);
}

std::vector<Balls> cut(Balls balls, std::size_t unit) {
  std::vector<Balls> parts;
  for (std::size_t first = 0; first < balls.size(); first += unit)
    parts.push_back(balls.subspan(first, std::min(unit, balls.size() - first)));
  return parts;
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

kernel::ClusterPack no_clusters() {
  kernel::ClusterPack empty{};
  std::fill(std::begin(empty.core), std::end(empty.core), never);
  std::fill(std::begin(empty.reach), std::end(empty.reach), never);
  return empty;
}

double reach_from(const Sphere& core, Balls balls) {
  double reach = 0.0;
  for (const Sphere& s : balls) reach = std::max(reach, (s.center - core.center).norm() + s.radius);
  return reach;
}

/// Its core is the ball over whose surface the others stick out least.
void set_cluster(kernel::ClusterPack& pack, std::size_t lane, Balls balls) {
  const Sphere* core = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& s : balls)
    if (const double excess = reach_from(s, balls) - s.radius; excess < least) {
      least = excess;
      core = &s;
    }
  pack.x[lane] = static_cast<float>(core->center.x());
  pack.y[lane] = static_cast<float>(core->center.y());
  pack.z[lane] = static_cast<float>(core->center.z());
  pack.core[lane] = static_cast<float>(core->radius);
  pack.reach[lane] = static_cast<float>(reach_from(*core, balls) + cluster_slack);
}

/// Packs of clusters, of sixteen each but the last.
void append(std::vector<kernel::ClusterPack>& packs, const std::vector<Balls>& groups) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (g % n_lanes == 0) packs.push_back(no_clusters());
    set_cluster(packs.back(), g % n_lanes, groups[g]);
  }
}

}  // namespace

void BallPacks::add(std::vector<Sphere> balls_B, kernel::Part& part) {
  order(balls_B, of_clusters);
  const std::vector<Balls> regions = cut(balls_B, of_clusters);
  part.first_pack = static_cast<int>(balls_.size() / n_lanes);
  part.n_packs = static_cast<int>(regions.size());
  for (const Balls& region : regions) order(region, of_pack);
  for (const Balls& pack : cut(balls_B, of_pack)) balls_.push_back(pack_of(pack));
  balls_.resize((balls_.size() + n_lanes - 1) / n_lanes * n_lanes, pack_of({}));
  part.first_cluster = static_cast<int>(clusters_.size());
  append(clusters_, cut(balls_B, of_pack));
  part.first_top = static_cast<int>(clusters_.size());
  if (part.n_packs > most_without_top) append(clusters_, regions);
  part.n_tops = static_cast<int>(clusters_.size()) - part.first_top;
}

}  // namespace eigengrasp
