// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <vector>

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// The ball that a shape is put into: x goes to (x - center) / radius, in the unit ball.
struct ShapeBall {
  Vec3 center = Vec3::Zero();  ///< [m]
  double radius = 1.0;         ///< [m], > 0
};

inline constexpr int kMaxZernikeOrder = 40;

/// Zernike moments of a function f on the unit ball (Novotni and Klein 2003, eq. 9; docs/theory/zernike.md):
///   Omega_nlm = 3/(4 pi) * integral of f Z_nlm,   0 <= l <= n <= order, n - l even, |m| <= l,
/// with real Z_nlm (m < 0: sine, m > 0: cosine of m phi) and 3/(4 pi) * integral of Z_nlm^2 = 1, so that the
/// moment 000 of the whole ball is 1. Plain data.
class ZernikeMoments {
 public:
  /// All 0. @throws std::logic_error for an order below 0 or above kMaxZernikeOrder
  explicit ZernikeMoments(int order);

  int order() const { return order_; }
  double& operator()(int n, int l, int m) { return values_[index(n, l, m)]; }
  double operator()(int n, int l, int m) const { return values_[index(n, l, m)]; }
  /// By l, then n, then m.
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

  /// The rotation invariants F_nl = sqrt(sum over m of Omega_nlm^2), by n, then l: 121 of order 20.
  std::vector<double> invariants() const;

 private:
  std::size_t index(int n, int l, int m) const {
    return first_[static_cast<std::size_t>(l)] + static_cast<std::size_t>((n - l) / 2 * (2 * l + 1) + l + m);
  }

  int order_ = 0;
  std::vector<std::size_t> first_;  ///< of each l
  std::vector<double> values_;
};

/// Number of pairs (n, l): 121 for order 20.
std::size_t zernike_invariant_count(int order);

/// Moments of the inside of a closed mesh (1 inside, 0 outside, more where it encloses space more than once):
/// by the divergence theorem integrals of polynomials over triangles, by Gauss rules that are exact, or, on
/// small triangles, to about 1e-6 of the largest moment. The rest is rounding. Triangles that are turned
/// inside out count negative. Cost: about 2 us a small triangle, 15 us a large one.
/// @pre the mesh lies in the ball (up to rounding)
ZernikeMoments compute_solid_moments(const TriangleMesh& mesh, const ShapeBall& ball, int order);

/// Moments of a surface's area (a unit mass spread evenly over the area, times 4 pi / 3): any triangles.
/// Accuracy and cost as compute_solid_moments. @pre some triangle has an area
ZernikeMoments compute_surface_moments(const TriangleMesh& mesh, const ShapeBall& ball, int order);

}  // namespace eigengrasp
