// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <vector>

#include "eigengrasp/quality/wrench_space.hpp"
#include "quality/expanding_polytope.hpp"
#include "quality/wrench_support.hpp"

namespace eigengrasp {
namespace {

/// Everything that an evaluation needs, kept so that the next one does not allocate.
struct Scratch {
  std::vector<Vec6> wrenches;
  std::vector<std::size_t> ends;
  detail::PointSupport points;
  detail::ConeSupport cones;
  detail::ExpandingPolytope polytope;
};

Scratch& scratch() {
  thread_local Scratch instance;
  return instance;
}

const detail::WrenchSupport& make_support(std::span<const ContactPoint> contacts,
                                          const WrenchSpaceOptions& options, Scratch& s) {
  if (options.cone == ConeModel::exact) {
    s.cones.assign(contacts, options);
    return s.cones;
  }
  s.wrenches.clear();
  s.ends.clear();
  for (const ContactPoint& contact : contacts) {
    append_edge_wrenches(contact, options, s.wrenches);
    s.ends.push_back(s.wrenches.size());
  }
  if (options.norm == WrenchNorm::linf) {
    s.points.assign_sum(s.wrenches, s.ends);
  } else {
    s.points.assign(s.wrenches);
  }
  return s.points;
}

WrenchSpaceQuality make_quality(const detail::DistanceBounds& bounds, double epsilon_min) {
  const double epsilon = std::max(0.0, bounds.upper);
  return {epsilon, epsilon > 0.0 && epsilon >= epsilon_min};
}

}  // namespace

WrenchSpaceQuality compute_epsilon(std::span<const ContactPoint> contacts,
                                   const WrenchSpaceOptions& options) {
  Scratch& s = scratch();
  const detail::WrenchSupport& support = make_support(contacts, options, s);
  detail::ExpansionGoal goal;
  if (options.cone == ConeModel::exact) goal.tolerance = options.tolerance;
  return make_quality(s.polytope.compute_distance(support, goal), options.epsilon_min);
}

WrenchSpaceQuality compute_epsilon(std::span<const Vec6> wrenches, double epsilon_min) {
  Scratch& s = scratch();
  s.points.assign(wrenches);
  return make_quality(s.polytope.compute_distance(s.points, {}), epsilon_min);
}

bool has_form_closure(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options) {
  Scratch& s = scratch();
  const detail::WrenchSupport& support = make_support(contacts, options, s);
  detail::ExpansionGoal goal;
  if (options.cone == ConeModel::exact) goal.tolerance = options.tolerance;
  goal.threshold = options.epsilon_min;
  return make_quality(s.polytope.compute_distance(support, goal), options.epsilon_min).form_closure;
}

}  // namespace eigengrasp
