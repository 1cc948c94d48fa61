// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <array>
#include <cmath>
#include <numbers>

#include "eigengrasp/quality/wrench_space.hpp"

namespace eigengrasp {
namespace {

/// Turns friction (x, y along the tangents, z about the normal, in units of mu) into a wrench.
class EdgeFrame {
 public:
  EdgeFrame(const ContactPoint& contact, const WrenchSpaceOptions& options)
      : contact_(contact),
        tangents_(contact_tangents(contact.n_OC)),
        lever_((contact.p_OC - options.torque_origin_O) / options.torque_scale),
        spin_(contact.n_OC * (contact.mu / options.torque_scale)) {}

  /// friction_torque [m]: torque about the normal over mu and normal force.
  Vec6 wrench(double x, double y, double friction_torque) const {
    const Vec3 force = contact_.n_OC + contact_.mu * (x * tangents_[0] + y * tangents_[1]);
    Vec6 w;
    w << force, lever_.cross(force) + friction_torque * spin_;
    return w;
  }

 private:
  const ContactPoint& contact_;
  std::array<Vec3, 2> tangents_;
  Vec3 lever_;
  Vec3 spin_;
};

struct Direction {
  double x, y;
};

/// Of the edges of a cone; the last number of edges that was asked for is kept.
const std::vector<Direction>& edge_directions(int edges) {
  thread_local std::vector<Direction> directions;
  if (directions.size() == static_cast<std::size_t>(edges)) return directions;
  directions.clear();
  for (int k = 0; k < edges; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / edges;
    directions.push_back({std::cos(angle), std::sin(angle)});
  }
  return directions;
}

void append_cone(const EdgeFrame& frame, int edges, std::vector<Vec6>& out) {
  for (const Direction& d : edge_directions(edges)) out.push_back(frame.wrench(d.x, d.y, 0.0));
}

void append_ellipsoid(const EdgeFrame& frame, double torsion_length, std::vector<Vec6>& out) {
  constexpr std::array<double, 5> kLatitudes = {90.0, 45.0, 0.0, -45.0, -90.0};
  constexpr std::array<int, 5> kDirections = {1, 5, 8, 5, 1};
  // Latitudes are no invariant of the ellipsoid, they depend on the unit of its third axis: millimetres here,
  // so that the samples are GraspIt!'s.
  constexpr double kMillimetre = 1e-3;
  const double axis = torsion_length / kMillimetre;
  for (std::size_t i = 0; i < kLatitudes.size(); ++i) {
    const double latitude = kLatitudes[i] * std::numbers::pi / 180.0;
    const double c = std::cos(latitude);
    const double s = std::sin(latitude);
    const double radius = 1.0 / std::hypot(c, s / axis);
    for (int k = 0; k < kDirections[i]; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections[i];
      out.push_back(
          frame.wrench(radius * c * std::cos(angle), radius * c * std::sin(angle), radius * s * kMillimetre));
    }
  }
}

}  // namespace

void append_edge_wrenches(const ContactPoint& contact, const WrenchSpaceOptions& options,
                          std::vector<Vec6>& out) {
  const EdgeFrame frame(contact, options);
  if (contact.torsion_length > 0.0) {
    append_ellipsoid(frame, contact.torsion_length, out);
  } else {
    append_cone(frame, options.edges, out);
  }
}

}  // namespace eigengrasp
