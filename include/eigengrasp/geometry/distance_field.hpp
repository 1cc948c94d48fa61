// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp {

/// Signed distance [m] and its gradient.
struct FieldSample {
  double distance = 0.0;         ///< negative inside
  Vec3 gradient = Vec3::Zero();  ///< of the distance; about unit length away from the medial axis
};

/// Values on a regular grid, trilinear in between.
struct FieldGrid {
  Vec3 origin = Vec3::Zero();  ///< of node (0, 0, 0) [m]
  double cell = 0.0;           ///< [m]
  Eigen::Vector3i nodes = Eigen::Vector3i::Zero();
  std::vector<float> values;  ///< x fastest

  Box box() const { return {origin, origin + cell * (nodes.array() - 1).cast<double>().matrix()}; }
  bool contains(const Vec3& p) const { return box().contains(p); }
  /// @pre contains(p) up to rounding
  FieldSample sample(const Vec3& p) const;
  double value(const Vec3& p) const;
};

struct DistanceFieldOptions {
  double cell = 0.0;          ///< of the fine grid [m]; 0: a 64th of the largest side, between 1 and 2 mm
  double margin = 0.020;      ///< of the fine grid about the object [m]
  double far_margin = 0.260;  ///< of the coarse grid about the object [m]
  Box region;                 ///< only this part of space is gridded; empty: all about the surface
  int threads = 0;            ///< 0: all; does not change the result
};

/// Signed distance to a surface on two nested grids, made once an object and shared by all threads. The sign
/// is that of the generalised winding number, so polygon soups have an inside where they nearly enclose one.
/// Error of the distance: exact at the nodes; in between at most about cell^2 / (8 r) at distance r from an
/// edge of the surface, and up to half a cell at the medial axis and inside walls thinner than a cell.
/// A cheap value: copies and scaled ones share the grids.
class DistanceField {
 public:
  struct Grids {
    FieldGrid fine;
    FieldGrid coarse;
  };

  DistanceField() = default;
  /// Cost: about 0.5 s of one core for 16,000 triangles.
  explicit DistanceField(const MeshBvh& bvh, const DistanceFieldOptions& options = {});
  explicit DistanceField(std::shared_ptr<const Grids> grids);

  /// The field of the surface made `factor` times larger about the origin, on the same grids: cells, margins
  /// and errors grow with it. Cost: nearly none. @pre factor > 0
  DistanceField scaled(double factor) const;

  /// Anywhere in space; outside both grids the nearest point seen from the grid's border stands for the true
  /// one.
  FieldSample sample(const Vec3& p) const;
  /// The distance alone; a lower cost.
  double distance(const Vec3& p) const;
  /// Whether a grid holds p; elsewhere the distance is only about right.
  bool covers(const Vec3& p) const { return coarse().contains(p * per_scale_); }

  /// The grids as they were made: the distance at p is scale() times their value at p / scale().
  const FieldGrid& fine() const { return grids_->fine; }
  const FieldGrid& coarse() const { return grids_->coarse; }
  double scale() const { return scale_; }
  const std::shared_ptr<const Grids>& grids() const { return grids_; }
  bool empty() const { return grids_->fine.values.empty(); }

 private:
  FieldSample sample_unscaled(const Vec3& p) const;

  std::shared_ptr<const Grids> grids_ = no_grids();
  double scale_ = 1.0;
  double per_scale_ = 1.0;

  static const std::shared_ptr<const Grids>& no_grids();
};

}  // namespace eigengrasp
