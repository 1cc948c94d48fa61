// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/unit_planner.hpp"

#include <fmt/format.h>

#include "eigengrasp/core/core_watch.hpp"

namespace eigengrasp {

namespace {

PlanOptions plan_options(const UnitOptions& options, const HandModel& hand, const StopFlag* stop) {
  PlanOptions plan;
  plan.search = SearchKind::enhanced;
  plan.iterations = options.states;
  plan.time_limit = options.time_limit;
  plan.grasps = options.grasps;
  plan.seed = options.seed;
  plan.threads = 1;
  plan.amplitudes = std::min(2, hand.n_dof());
  plan.stop = stop;
  return plan;
}

}  // namespace

std::vector<std::string> UnitOptions::validate() const {
  std::vector<std::string> violations;
  if (grasps < 1 || grasps > 100000)
    violations.push_back(fmt::format("grasps is {}, expected 1 to 100000", grasps));
  if (states < 1) violations.push_back(fmt::format("states is {}, expected 1 or more", states));
  if (!(time_limit > 0.0) || !(time_limit <= 1e6))
    violations.push_back(fmt::format("time limit is {} s, expected more than 0 and at most 1e6", time_limit));
  return violations;
}

GraspSource builder_source() {
  return {"eigengrasp", "form-closure grasps of 'eigengrasp db build', by the enhanced search"};
}

std::optional<UnitResult> plan_unit(const UnitKey& key, const PreparedHand& hand, PreparedObject& object,
                                    const UnitOptions& options, const StopFlag* stop) {
  const CoreWatch watch;
  const auto model = object.collision_model(hand, key.scale);
  PlanResult plan = plan_grasps(*model, plan_options(options, *hand.model, stop));
  if (stop != nullptr && stop->stop_requested()) return std::nullopt;
  UnitResult result;
  result.key = key;
  if (plan.stopped_early)
    result.reason = fmt::format("the time limit of {} s was reached; ", options.time_limit);
  for (Grasp& g : plan.grasps) {
    g.object = key.object;
    g.object_scale = key.scale;
    g.hand = key.hand;
    result.grasps.push_back({0, builder_source().name, std::move(g)});
  }
  if (result.grasps.empty()) {
    result.state = UnitState::failed;
    result.reason += plan.explanation;
  } else if (plan.stopped_early) {
    result.reason += fmt::format("{} of {} grasps were found", result.grasps.size(), options.grasps);
  }
  result.seconds = watch.seconds();
  return result;
}

}  // namespace eigengrasp
