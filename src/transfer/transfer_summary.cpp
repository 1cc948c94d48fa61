// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "transfer/transfer_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/database/graspable_size.hpp"

namespace eigengrasp {

std::string transfer_planner_name(const TransferOptions& options) {
  std::string name =
      fmt::format("{}{}/{}", kTransferPlanner, to_string(*options.distance), options.candidates.alignment);
  if (options.from_hand) name += "/" + options.from_hand->name;
  return name;
}

namespace {

int count_candidates(const TransferResult& result) {
  int n = 0;
  for (const UsedNeighbor& neighbor : result.neighbors) n += neighbor.candidates;
  return n;
}

/// The neighbours are of quite other sizes.
std::string size_sentence(const ObjectModel& object, const TransferResult& result) {
  double least = result.neighbors.front().radius, most = least;
  for (const UsedNeighbor& n : result.neighbors) {
    least = std::min(least, n.radius);
    most = std::max(most, n.radius);
  }
  const double radius = approximate_radius(object.mesh, object.center_of_mass);
  return fmt::format(
      "no pre-grasps: the object's approximate radius is {:.3g} m, and those of its {} neighbours at scale 1 "
      "are "
      "{:.3g} to {:.3g} m; grasps are taken from objects that differ by at most {:g} times (are the units "
      "right?)",
      radius, result.neighbors.size(), least, most, kMostSizeRatio);
}

}  // namespace

void explain_transfer(const ObjectModel& object, const TransferOptions& options, TransferResult& result) {
  PlanResult& plan = result.plan;
  const int candidates = count_candidates(result);
  if (candidates == 0) {
    plan.explanation = size_sentence(object, result);
    return;
  }
  const CandidateCounts& c = plan.candidates;
  const std::string tests = fmt::format(
      "{} pre-grasps of {} neighbours: {} form-closed, {} touched without form closure, {} without contact, "
      "{} "
      "penetrating, {} not brought free of the object",
      candidates, result.neighbors.size(), c.form_closed, c.not_closed, c.no_contact, c.penetrating,
      candidates - c.tested);
  if (plan.status != PlanStatus::found) {
    const std::string lack = c.form_closed > 0
                                 ? fmt::format("no grasp whose epsilon is above {:g}", options.min_epsilon)
                                 : std::string("no form-closed grasp");
    plan.explanation = fmt::format(
        "{}: {}; more neighbours (--neighbors), all their pre-grasps (--candidates 0), or "
        "a "
        "search ('eigengrasp plan') may help",
        lack, tests);
    return;
  }
  plan.explanation = fmt::format("{}; {} distinct", tests, result.distinct);
  if (options.min_epsilon > 0.0)
    plan.explanation += fmt::format(" with an epsilon above {:g}", options.min_epsilon);
  if (plan.grasps.size() < static_cast<std::size_t>(result.distinct))
    plan.explanation += fmt::format(", the best {} kept", plan.grasps.size());
}

}  // namespace eigengrasp
