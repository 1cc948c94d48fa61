// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/plan_summary.hpp"

#include <fmt/format.h>

namespace eigengrasp {

std::string planner_name(const PlanOptions& options) {
  const char* const search = options.search == SearchKind::paper       ? "annealing"
                             : options.search == SearchKind::staged    ? "staged"
                             : options.search == SearchKind::tempering ? "tempering"
                             : options.search == SearchKind::enhanced  ? "enhanced"
                                                                       : "transfer";
  return fmt::format("{}/{}", search, options.energy == EnergyKind::wrench ? "wrench" : "contact");
}

std::string options_digest(const PlanOptions& options) {
  const std::string text = fmt::format(
      "{} {} {} {} {} {} {} {} {} {} {} {} {}", options.iterations, options.time_limit, options.grasps,
      options.chains, options.amplitudes, static_cast<int>(options.energy), static_cast<int>(options.search),
      options.alpha, static_cast<int>(options.norm), static_cast<int>(options.cone), options.cone_edges,
      options.epsilon_min, options.torque_scale);
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

namespace {

std::string states_sentence(const StateCounts& s) {
  return fmt::format(
      "of {} states {} collided with the object, {} with the hand itself, {} with obstacles, {} were legal",
      s.evaluated, s.hit_object, s.hit_itself, s.hit_obstacle, s.legal);
}

std::string advice(const Scene& scene, const PlanResult& result) {
  const double reach = hand_reach(*scene.hand);
  const double radius = scene.object->max_radius;
  if (radius > 4.0 * reach)
    return fmt::format(
        "; the object is {:.3g} m in radius and the hand reaches {:.3g} m: too large (are the units right?)",
        radius, reach);
  if (radius < 0.05 * reach)
    return fmt::format(
        "; the object is {:.3g} m in radius and the hand reaches {:.3g} m: too small (are the units right?)",
        radius, reach);
  if (result.states.hit_itself > result.states.evaluated / 2)
    return "; the hand mostly collides with itself: see 'eigengrasp hand check'";
  if (result.candidates.no_contact > result.candidates.tested / 2)
    return "; most closed hands do not reach the object: is the hand large enough, and do its closing "
           "directions close it?";
  return "; more iterations (--iterations) or another seed (--seed) may help";
}

}  // namespace

void explain(const Scene& scene, const PlanOptions&, PlanResult& result) {
  const CandidateCounts& c = result.candidates;
  std::string tests = fmt::format(
      "{} pre-grasps closed: {} form-closed, {} touched without form closure, {} without contact, {} "
      "penetrating",
      c.tested, c.form_closed, c.not_closed, c.no_contact, c.penetrating);
  if (result.closed_on_the_way > c.tested)
    tests += fmt::format(", chosen from {} that the search closed", result.closed_on_the_way);
  if (c.form_closed > 0) {
    result.status = PlanStatus::found;
    result.explanation = tests;
  } else if (c.tested > 0) {
    result.status = PlanStatus::none_closed;
    result.explanation = fmt::format("no form-closed grasp: {}; {}{}", tests, states_sentence(result.states),
                                     advice(scene, result));
  } else {
    result.status = PlanStatus::nothing_legal;
    result.explanation =
        fmt::format("no legal pre-grasp: {}{}", states_sentence(result.states), advice(scene, result));
  }
}

}  // namespace eigengrasp
