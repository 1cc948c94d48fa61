// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"
#include "server/http_types.hpp"

namespace eigengrasp::server {

/// A plan that ended.
struct PlanRecord {
  std::string id;
  std::shared_ptr<const CollisionModel> model;
  double scale = 1.0;
  PlanOptions options;
  PlanResult result;
};

/// The last plans of all sessions, and the files that can be had of them. From any thread.
class PlanStore {
 public:
  void add(PlanRecord record);
  /// A file of a plan: grasps.json, grasps.csv, grasps.png, grasp-N.glb. Cost: up to a second for a picture.
  HttpReply file(const std::string& id, const std::string& name) const;

 private:
  static constexpr std::size_t kept = 32;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const PlanRecord>> records_;
};

}  // namespace eigengrasp::server
