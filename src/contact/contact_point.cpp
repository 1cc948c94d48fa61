// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/contact/contact_point.hpp"

#include <cmath>
#include <numbers>

namespace eigengrasp {
namespace {

constexpr double kMaxRadius = 0.020;     // [m] flatter surfaces count as a sphere of this radius
constexpr double kPadThickness = 0.003;  // [m]
constexpr double kNormalForce = 5.0;     // [N]

double contact_radius(double curvature) {
  // Written so that a NaN of a failed curvature fit counts as flat.
  return curvature > 1.0 / kMaxRadius ? 1.0 / curvature : kMaxRadius;
}

}  // namespace

std::array<Vec3, 2> contact_tangents(const Vec3& n) {
  constexpr double parallel = 1e-3;
  const Vec3 across = n.cross(Vec3::UnitX());
  const Vec3 t1 = across.norm() > parallel ? across.normalized() : n.cross(Vec3::UnitZ()).normalized();
  return {t1, n.cross(t1)};
}

double soft_finger_torsion_length(double k1, double k2, double youngs_modulus) {
  const double r1 = contact_radius(k1);
  const double r2 = contact_radius(k2);
  const double indentation =
      std::sqrt(kNormalForce * kPadThickness / (youngs_modulus * std::numbers::pi * std::sqrt(r1 * r2)));
  const double a = std::sqrt(2.0 * indentation * r1);
  const double b = std::sqrt(2.0 * indentation * r2);
  return 8.0 * std::sqrt(a * b) / 15.0;
}

}  // namespace eigengrasp
