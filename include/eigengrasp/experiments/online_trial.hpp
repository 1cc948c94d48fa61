// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/result_picture.hpp"
#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/online/simulated_operator.hpp"

namespace eigengrasp {

struct OnlineTrialOptions {
  int directions = 40;      ///< new approach directions a scene, for the time to the first grasp
  double time_limit = 2.0;  ///< [s] after which a direction counts as one without a grasp
  int approaches = 10;      ///< of the simulated operator a scene
  double give_up = 20.0;    ///< [s] after which an approach without a click counts as failed
  std::uint64_t seed = 1;
  OperatorTraits traits;
  OnlineOptions online;
  const StopFlag* stop = nullptr;
};

/// One approach of the simulated operator.
struct OnlineApproach {
  bool clicked = false;
  bool form_closed = false;  ///< what the click made
  double epsilon = 0.0;      ///< of it
  double seconds = 0.0;      ///< from its beginning to the click, or until it was given up
  int directions = 1;        ///< that were tried
};

/// A moment of an approach (Fig. 8).
struct OnlineMoment {
  std::string title;
  Pose X_OH = Pose::Identity();
  VecX joints;
  std::optional<Grasp> offer;   ///< drawn as a ghost at its pre-grasp
  std::optional<Grasp> closed;  ///< its contacts are drawn
};

/// How the online planner did with one hand and object.
struct OnlineSceneTrial {
  std::string hand;
  std::string object;
  double postures_per_second = 0.0;
  double candidates_per_second = 0.0;
  std::int64_t candidates = 0;
  std::int64_t form_closed = 0;
  /// From a new direction to its first form-closed grasp [s]; infinity: none within the limit.
  std::vector<double> first_grasp;
  std::vector<OnlineApproach> approaches;
  std::vector<double> updates;        ///< [s] of OnlinePlanner::update, each
  std::vector<OnlineMoment> moments;  ///< of one approach that ended well
};

/// Runs the online planner in real time with the simulated operator: one thread searches, one tests.
OnlineSceneTrial try_online(std::shared_ptr<const CollisionModel> model, const OnlineTrialOptions& options);

/// Several scenes with the circumstances.
struct OnlineReport {
  ExperimentRecord record;
  OnlineTrialOptions options;
  std::vector<OnlineSceneTrial> scenes;
  /// From a wrist pose on the wire to the updated hand on the wire [s]; empty: not measured.
  std::vector<double> wire_latency;
};

std::string online_text(const OnlineSceneTrial& scene);
/// A table of targets and figures, in Markdown.
std::string online_targets(const OnlineReport& report);
std::string online_json(const OnlineReport& report);
/// A page: targets and figures, the distribution of the times to the first grasp, all scenes.
std::string online_markdown(const OnlineReport& report);
/// Fig. 8: one complete approach.
ResultPicture online_picture(const Scene& scene, const OnlineSceneTrial& trial, int threads);

}  // namespace eigengrasp
