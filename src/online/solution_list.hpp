// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/planning/pregrasp_list.hpp"

namespace eigengrasp {

/// Form-closure grasps that were found, and which of them is offered. Those that the wrist has left behind
/// are dropped after a while. Not safe to share without a lock.
class SolutionList {
 public:
  SolutionList(const Scene& scene, const OnlineOptions& options);

  /// Takes a grasp in; of two that are alike the one with the higher epsilon stays. @param now [s]
  void add(const Grasp& grasp, const Pose& X_OW, double now);

  /// Drops what is out of reach and picks the grasp to offer: the one nearest to the present approach, of
  /// those about as near the one with the highest epsilon. The last one stays unless it is out of reach or
  /// another is clearly nearer or better, and the offer was not changed a moment ago.
  void update(const Pose& X_OW, double now);

  const Grasp* offered() const;
  const Grasp* find(std::uint64_t id) const;
  /// As seen from a wrist: the offered one first, then by rising angle.
  std::vector<OnlineSolution> list(const Pose& X_OW, double now) const;
  bool any_in_reach(const Pose& X_OW) const;
  void clear();

 private:
  struct Solution {
    std::uint64_t id;
    Grasp grasp;
    double found;
    double in_reach;  ///< when it last was
  };

  OnlineSolution seen_from(const Solution& s, const Pose& X_OW, double now) const;
  bool in_reach(const OnlineSolution& s) const;
  bool clearly_better(const OnlineSolution& a, const OnlineSolution& b) const;
  const Solution* get(std::uint64_t id) const;

  const Scene& scene_;
  const OnlineOptions& options_;
  Distinctness distinct_;
  std::vector<Solution> solutions_;
  std::uint64_t next_id_ = 1;
  std::uint64_t offered_ = 0;  ///< id; 0: none
  double offered_since_ = 0.0;
};

}  // namespace eigengrasp
