// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <vector>

#include "eigengrasp/contact/contact_point.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/quality/wrench_space.hpp"

namespace eigengrasp::testing {

inline Vec3 random_direction(RandomStream& random) {
  Vec3 v(random.normal(), random.normal(), random.normal());
  return v.normalized();
}

/// Contacts on an ellipsoid the size of a hand, pressing inwards with some scatter.
inline std::vector<ContactPoint> random_contacts(int n, double mu, double torsion_length,
                                                 std::uint64_t seed) {
  RandomStream random{seed, 0xC0};
  std::vector<ContactPoint> contacts;
  for (int i = 0; i < n; ++i) {
    const Vec3 v = random_direction(random);
    const Vec3 inwards = -(v + 0.3 * random.uniform() * random_direction(random)).normalized();
    contacts.push_back({v.cwiseProduct(Vec3(0.03, 0.04, 0.05)), inwards, mu, torsion_length});
  }
  return contacts;
}

/// Torques about the centre over 50 mm.
inline WrenchSpaceOptions hand_options() {
  WrenchSpaceOptions options;
  options.torque_scale = 0.05;
  return options;
}

inline std::vector<Vec6> edge_wrenches(const std::vector<ContactPoint>& contacts,
                                       const WrenchSpaceOptions& o) {
  std::vector<Vec6> wrenches;
  for (const ContactPoint& c : contacts) append_edge_wrenches(c, o, wrenches);
  return wrenches;
}

}  // namespace eigengrasp::testing
