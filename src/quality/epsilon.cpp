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

WrenchSpaceQuality make_quality(double epsilon, double epsilon_min, const Vec6& weakest) {
  return {epsilon, epsilon > 0.0 && epsilon >= epsilon_min, weakest};
}

/// Tells the two sides of epsilon_min apart, so finely that it does not matter beside epsilon_min itself.
detail::ExpansionGoal closure_goal(const WrenchSpaceOptions& options) {
  detail::ExpansionGoal goal;
  goal.threshold = options.epsilon_min;
  if (options.cone == ConeModel::exact) {
    const double fine = options.epsilon_min > 0.0 ? 1e-3 * options.epsilon_min : options.tolerance;
    goal.tolerance = std::min(options.tolerance, fine);
  }
  return goal;
}

}  // namespace

WrenchSpaceQuality compute_epsilon(std::span<const ContactPoint> contacts,
                                   const WrenchSpaceOptions& options) {
  Scratch& s = scratch();
  const detail::WrenchSupport& support = make_support(contacts, options, s);
  detail::ExpansionGoal goal;
  if (options.cone == ConeModel::exact) goal.tolerance = options.tolerance;
  detail::DistanceBounds bounds = s.polytope.compute_distance(support, goal);
  const double loose = bounds.upper;
  // The tolerance may straddle epsilon_min; closure has to come out as has_form_closure() says.
  if (bounds.lower < options.epsilon_min && options.epsilon_min <= bounds.upper) {
    bounds = s.polytope.compute_distance(support, closure_goal(options));
  }
  return make_quality(std::min(loose, bounds.upper), options.epsilon_min, bounds.weakest);
}

WrenchSpaceQuality compute_epsilon(std::span<const Vec6> wrenches, double epsilon_min) {
  return estimate_epsilon(wrenches, epsilon_min, {});
}

WrenchSpaceQuality estimate_epsilon(std::span<const Vec6> wrenches, double epsilon_min,
                                    const RoughEpsilon& rough) {
  Scratch& s = scratch();
  s.points.assign(wrenches);
  detail::ExpansionGoal goal;
  goal.enough_below = rough.at_least;
  if (rough.most_expansions > 0) goal.most_expansions = static_cast<std::size_t>(rough.most_expansions);
  const detail::DistanceBounds bounds = s.polytope.compute_distance(s.points, goal);
  return make_quality(bounds.upper, epsilon_min, bounds.weakest);
}

bool has_form_closure(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options) {
  Scratch& s = scratch();
  const detail::WrenchSupport& support = make_support(contacts, options, s);
  const detail::DistanceBounds bounds = s.polytope.compute_distance(support, closure_goal(options));
  return make_quality(bounds.upper, options.epsilon_min, bounds.weakest).form_closure;
}

}  // namespace eigengrasp
