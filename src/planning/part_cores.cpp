// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/part_cores.hpp"

#include <algorithm>
#include <limits>

namespace eigengrasp {

namespace {

constexpr std::size_t most_cores = 3;  // of a part
constexpr float never = -1e9f;         // radius of a ball that meets nothing
constexpr double field_slack = 0.0003;  // [m] for the field's error at a core's centre

std::vector<Sphere> choose_cores(const std::vector<Sphere>& balls) {
  std::vector<Sphere> chosen;
  const auto merit = [&](const Sphere& s) {
    double away = chosen.empty() ? 0.0 : std::numeric_limits<double>::infinity();
    for (const Sphere& c : chosen) away = std::min(away, (c.center - s.center).norm());
    return s.radius + 0.5 * away;
  };
  while (chosen.size() < std::min(most_cores, balls.size()))
    chosen.push_back(*std::max_element(
        balls.begin(), balls.end(), [&](const Sphere& a, const Sphere& b) { return merit(a) < merit(b); }));
  return chosen;
}

/// Of each core, how far the balls reach that are nearer to it than to the others.
std::vector<double> reaches_of(const std::vector<Sphere>& cores, const std::vector<Sphere>& balls) {
  std::vector<double> reaches(cores.size(), 0.0);
  for (const Sphere& s : balls) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < cores.size(); ++k)
      if ((cores[k].center - s.center).norm() < (cores[nearest].center - s.center).norm()) nearest = k;
    reaches[nearest] = std::max(reaches[nearest], (cores[nearest].center - s.center).norm() + s.radius);
  }
  return reaches;
}

kernel::CorePack no_cores() {
  kernel::CorePack pack{};
  std::fill(std::begin(pack.radius), std::end(pack.radius), never);
  std::fill(std::begin(pack.reach), std::end(pack.reach), never);
  return pack;
}

}  // namespace

void PartCores::add(const std::vector<Sphere>& balls_B, int number, kernel::Part& part) {
  const std::vector<Sphere> chosen = choose_cores(balls_B);
  const std::vector<double> reaches = reaches_of(chosen, balls_B);
  part.first_core = size();
  part.n_cores = static_cast<int>(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::size_t lane = cores_.size() % kernel::n_lanes;
    if (lane == 0) packs_.push_back(no_cores());
    kernel::CorePack& pack = packs_.back();
    pack.place[lane] = 3 * kernel::n_lanes * size();
    pack.radius[lane] = static_cast<float>(chosen[k].radius);
    pack.reach[lane] = static_cast<float>(reaches[k] + field_slack);
    pack.part[lane] = number;
    kernel::CoreBall core{};
    for (int i = 0; i < 3; ++i) core.center[i] = static_cast<float>(chosen[k].center[i]);
    cores_.push_back(core);
  }
}

}  // namespace eigengrasp
