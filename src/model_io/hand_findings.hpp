// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <utility>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "eigengrasp/model_io/hand_check.hpp"

namespace eigengrasp {

/// Where the checks put what they find.
class Findings {
 public:
  template <typename... Args>
  void add(HandFinding::Severity severity, fmt::format_string<Args...> format, Args&&... args) {
    list_.push_back({severity, fmt::format(format, std::forward<Args>(args)...)});
  }
  std::vector<HandFinding> sorted() &&;

 private:
  std::vector<HandFinding> list_;
};

/// The surfaces of a hand, prepared for queries, and its links in the rest posture.
struct HandSurfaces {
  std::vector<MeshBvh> links;
  std::vector<bool> solid;  ///< closed, so that inside and outside are known
  std::vector<Pose> X_HL;   ///< in the rest posture
};
HandSurfaces prepare_surfaces(const HandModel& hand);

void check_meshes(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings);
void check_sizes(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings);
void check_rest_collisions(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings);
void check_contacts(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings);
void check_closing(const HandModel& hand, Findings& findings);
void check_limits(const HandModel& hand, Findings& findings);
void check_eigengrasps(const HandModel& hand, Findings& findings);

}  // namespace eigengrasp
