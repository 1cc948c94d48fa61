// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <vector>

#include "eigengrasp/quality/wrench_space.hpp"

namespace eigengrasp::detail {

/// A convex set of wrenches, known by its support function.
class WrenchSupport {
 public:
  virtual ~WrenchSupport() = default;
  /// max of u . w over the set, and a w where it is reached. Lowest double for the empty set.
  virtual double support(const Vec6& u, Vec6& w) const = 0;
  /// Largest |w| of the set, up to a small factor; 0 for the empty set.
  virtual double scale() const = 0;
};

/// Convex hull of wrenches, or with groups the hull of the Minkowski sum of the groups, each joined with the
/// origin. Keeps its memory between calls.
class PointSupport : public WrenchSupport {
 public:
  /// The hull of all wrenches.
  void assign(std::span<const Vec6> wrenches);
  /// Group g is wrenches [ends[g - 1], ends[g]). The groups are added up.
  void assign_sum(std::span<const Vec6> wrenches, std::span<const std::size_t> ends);

  double support(const Vec6& u, Vec6& w) const override;
  double scale() const override { return scale_; }

 private:
  void store(std::span<const Vec6> wrenches);
  void compute_dots(const Vec6& u) const;
  Vec6 wrench(std::size_t i) const;

  std::size_t n_ = 0;
  std::size_t stride_ = 0;           // n_, rounded up
  std::vector<double> coordinates_;  // 6 rows of stride_ numbers
  std::vector<std::size_t> ends_;    // empty: one hull
  mutable std::vector<double> dots_;
  double scale_ = 0.0;
};

/// The wrench space of true friction cones and ellipsoids (field-notes of the limit surface in
/// contact_point.hpp): hull of the union (l1), or Minkowski sum with the origin in each summand (linf).
class ConeSupport : public WrenchSupport {
 public:
  void assign(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options);

  double support(const Vec6& u, Vec6& w) const override;
  double scale() const override { return scale_; }

 private:
  struct Cone {
    Vec3 n, lever;    // lever: arm over torque scale
    double mu, spin;  // spin: torsion length over torque scale
    double support(const Vec6& u) const;
    void add_point(const Vec6& u, Vec6& w) const;
  };
  std::vector<Cone> cones_;
  WrenchNorm norm_ = WrenchNorm::l1;
  double scale_ = 0.0;
};

}  // namespace eigengrasp::detail
