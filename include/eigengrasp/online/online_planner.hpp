// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/online/online_view.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

struct OnlineOptions {
  std::uint64_t seed = 1;
  int amplitudes = 2;
  double cone_half_angle = 0.7853981633974483;  ///< theta's range [rad]
  double look_ahead = 0.40;                     ///< farthest distance along the approach [m]
  double step_back = 0.03;                      ///< how far behind the wrist pre-grasps may lie [m]
  std::int64_t restart_after = 2000;            ///< iterations of a chain (section IV-D)
  std::size_t queue = 20;                       ///< candidates that wait for the second stage
  std::size_t solutions = 10;                   ///< that are kept
  double epsilon_min = 1e-3;                    ///< of a grasp that is offered
  int test_threads = 1;                         ///< of the second stage
  double preshape_begins = 0.10;                ///< distance from the offered pre-grasp at which the fingers
                                                ///< begin to take its posture [m]
  WrenchNorm norm = WrenchNorm::l1;

  /// All violations as sentences: name, value, bound. Empty: the options are sound.
  std::vector<std::string> validate(const HandModel& hand) const;
};

/// The online planner of section IV: searches a cone ahead of the operator's wrist (first stage, a thread of
/// its own), closes and rates what it finds (second stage, threads of its own), keeps form-closure grasps and
/// offers the one nearest to the present approach. All functions may be called from any thread, and return
/// at once but for `update` and `command`.
class OnlinePlanner {
 public:
  /// Prepares the scene (see CollisionModel for the cost) and starts to search with the first wrist pose.
  /// @throws Error where the options are not sound.
  OnlinePlanner(Scene scene, const OnlineOptions& options, std::shared_ptr<PreparationCache> cache = {});
  /// The same for a scene that was prepared before. @pre the model was prepared with Options::fast
  OnlinePlanner(const std::shared_ptr<const CollisionModel>& model, const OnlineOptions& options);
  /// Stops the threads.
  ~OnlinePlanner();

  WristTrack::Taken set_wrist(const WristSample& sample);
  /// Replaces all targets. @throws Error where one names a variable that there is not, or is out of range
  void set_targets(std::vector<VariableTarget> targets);
  /// Carries a command out; returns the grasp that "close" made (form_closure tells whether it holds; none
  /// where the hand touches nothing or nothing was to be closed). Cost of close: 1-5 ms.
  std::optional<Grasp> command(OperatorCommand command);

  /// What is to be shown now: takes the newest wrist pose, picks the offer, preshapes the fingers and makes
  /// sure that the hand is free of collision. Cost: 0.2-1 ms.
  OnlineView update();
  /// A solution with all its numbers; none where it is not kept any more.
  std::optional<Grasp> solution(std::uint64_t id) const;

  const Scene& scene() const;
  const OnlineOptions& options() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace eigengrasp
