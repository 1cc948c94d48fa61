// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/grasp/grasp.hpp"

namespace eigengrasp {

std::vector<ContactPoint> contact_points(const std::vector<GraspContact>& contacts) {
  std::vector<ContactPoint> points;
  points.reserve(contacts.size());
  for (const GraspContact& c : contacts) points.push_back(c.point);
  return points;
}

}  // namespace eigengrasp
