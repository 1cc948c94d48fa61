// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <vector>

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Point of a surface that is nearest to a query point.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double distance = 0.0;  ///< unsigned [m]
  int triangle = -1;      ///< -1: none within the bound
};

/// The nearest pair of points of two surfaces, both in the frame of the first.
struct ClosestPair {
  Vec3 p_a = Vec3::Zero();
  Vec3 p_b = Vec3::Zero();
  double distance = 0.0;  ///< [m]; 0 where the surfaces intersect
  int triangle_a = -1;    ///< -1: none within the bound
  int triangle_b = -1;
};

/// Bounding-volume hierarchy (axis-aligned boxes, a few triangles a leaf) over the triangles of a mesh, with
/// exact queries in double precision. Holds its own copy of the triangle corners. Degenerate triangles count
/// as segments or points. Immutable, any number of threads.
class MeshBvh {
 public:
  MeshBvh() = default;
  explicit MeshBvh(const TriangleMesh& mesh);

  bool empty() const { return nodes_.empty(); }
  std::size_t triangle_count() const { return corners_.size(); }

  /// Nearest surface point to p, if it is nearer than max_distance.
  ClosestPoint closest_point(const Vec3& p,
                             double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Generalised winding number of the surface about p (Jacobson et al. 2013; far nodes as dipoles, Barill et
  /// al. 2018): 1 inside, 0 outside a closed mesh, something between for soups and holes.
  double winding_number(const Vec3& p) const;

  /// Inside by the winding number: above one half.
  bool contains(const Vec3& p) const { return winding_number(p) > 0.5; }

  /// Distance [m], negative inside.
  double signed_distance(const Vec3& p) const;

  /// Whether two surfaces have a point in common; b is posed in the frame of a by X_AB. A surface wholly
  /// inside the other does not intersect it.
  friend bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB);

  /// Nearest pair of two surfaces, if nearer than max_distance.
  friend ClosestPair closest_pair(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance);

  /// Calls visit(triangle_a, triangle_b, pair) for every pair of triangles whose distance is at most
  /// max_distance.
  friend void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                                   const std::function<void(const ClosestPair&)>& visit);

  struct Corners {
    Vec3 a, b, c;
  };
  /// Corners of triangle t (index as in the mesh).
  const Corners& corners(int t) const { return corners_[static_cast<std::size_t>(t)]; }
  const Box& box() const { return root_box_; }

  struct Node {
    Box box;
    int first = 0;  ///< leaf: index into order_; inner: index of the left child (the right one follows)
    int count = 0;  ///< triangles of a leaf; 0 for an inner node
    Vec3 dipole_center = Vec3::Zero();  ///< area-weighted
    Vec3 dipole = Vec3::Zero();         ///< sum of area vectors [m^2]
    double radius = 0.0;                ///< about dipole_center [m]
  };

 private:
  void build(int node, int first, int count, int depth);

  std::vector<Corners> corners_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  Box root_box_;
};

bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB);
ClosestPair closest_pair(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB,
                         double max_distance = std::numeric_limits<double>::infinity());
void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                          const std::function<void(const ClosestPair&)>& visit);

}  // namespace eigengrasp
