// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// A pre-grasp that was made for another object, in the frame of this one.
struct GivenPreGrasp {
  Pose X_OH = Pose::Identity();
  VecX dofs;  ///< (n_dof)
};

/// Names of planners that transfer grasps begin with this. They close fingers without distance fields, with
/// which contacts come out a little differently.
inline constexpr const char* kTransferPlanner = "transfer/";

/// What became of a given pre-grasp.
enum class GivenOutcome : char {
  skipped,  ///< after a stop or at the time limit
  unfit,    ///< could not be brought away from the object, or hits something else
  no_contact,
  penetrating,
  not_closed,  ///< epsilon at or below the threshold
  form_closed,
};

struct RatedPreGrasps {
  /// Form-closed grasps alone, distinct, by falling epsilon, at most options.grasps; no explanation. The
  /// candidates are counted before those that are not distinct are left out.
  PlanResult plan;
  std::vector<std::size_t> origins;    ///< of each grasp, among the given ones
  std::vector<GivenOutcome> outcomes;  ///< of each given one
  int distinct = 0;                    ///< grasps before the best options.grasps were taken
};

/// The body of Algorithm 1 (section VI-A of the paper) for every given pre-grasp: fit_pregrasp, close the
/// fingers, rate; kept where epsilon is above the threshold and the closed hand passes the exact checks of
/// plan_grasps. One that does not close after its forward motion is closed where it was free, too. Of two
/// grasps that are not distinct (Distinctness) the better stays. They are tried in their order, so that a
/// stop or the time limit leaves out the last ones; without those the result does not depend on the number
/// of threads. Of the options count grasps, time_limit, threads, amplitudes, seed, stop, and those of the
/// wrench space. plan.timings.close is all but the volumes.
/// @param min_epsilon threshold beside options.epsilon_min
/// Cost: 3 ms each with 3 fingers, 7 ms with 5. @throws Error with the first sentence of options.validate()
/// where they are not sound
RatedPreGrasps rate_pregrasps(const CollisionModel& model, const std::vector<GivenPreGrasp>& given,
                              const PlanOptions& options, double min_epsilon = 0.0);

}  // namespace eigengrasp
