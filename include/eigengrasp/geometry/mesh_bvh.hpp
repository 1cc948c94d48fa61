// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "eigengrasp/geometry/triangle_queries.hpp"

namespace eigengrasp {

/// Point of a surface that is nearest to a query point.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double distance = 0.0;  ///< unsigned [m]
  int triangle = -1;      ///< -1: none within the bound
};

/// A pair of points of two surfaces a and b, both in the frame of a.
struct ClosestPair {
  Vec3 p_a = Vec3::Zero();
  Vec3 p_b = Vec3::Zero();
  double distance = 0.0;  ///< [m]; 0 where the surfaces intersect
  int triangle_a = -1;    ///< -1: none within the bound
  int triangle_b = -1;
};

/// Bounding-volume hierarchy (axis-aligned boxes) over the triangles of a mesh, with exact queries in double
/// precision; of two hierarchies with oriented boxes in single precision, rounded outwards. Holds its own
/// copy of the corners; degenerate triangles count as segments or points. Immutable, any number of threads.
/// Boxes are in the mesh's own frame; in queries of two hierarchies b is turned into the frame of a.
class MeshBvh {
 public:
  MeshBvh() = default;
  /// Cost: about 1 us a triangle. @pre indices in range, finite vertices
  explicit MeshBvh(const TriangleMesh& mesh);

  bool empty() const { return nodes_.empty(); }
  int triangle_count() const { return static_cast<int>(corners_.size()); }
  const Box& box() const { return box_; }
  /// Corners of triangle t (index as in the mesh).
  const TriangleCorners& corners(int t) const { return corners_[static_cast<std::size_t>(t)]; }

  /// Nearest surface point to p, if it is nearer than max_distance. Cost: 1-2 us.
  ClosestPoint closest_point(const Vec3& p,
                             double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Generalised winding number of the surface about p (Jacobson et al. 2013), far nodes as dipoles (Barill
  /// et al. 2018): 1 inside and 0 outside a closed mesh, something between for soups and holes. Cost: 2-5 us.
  double winding_number(const Vec3& p) const;

  /// Inside by the winding number: above one half.
  bool contains(const Vec3& p) const { return box_.contains(p) && winding_number(p) > 0.5; }

  /// Distance [m], negative inside.
  double signed_distance(const Vec3& p) const;

  struct Node {
    Box box;
    int left =
        0;  ///< inner: index of the left child, the right one follows; leaf: first triangle in leaf order
    int count = 0;  ///< triangles of a leaf; 0 for an inner node
  };
  struct Dipole {
    Vec3 center = Vec3::Zero();  ///< area-weighted [m]
    Vec3 moment = Vec3::Zero();  ///< sum of area vectors [m^2]
    double radius = 0.0;         ///< of the node about the centre [m]
  };
  /// A box about a node's triangles that is turned as they lie: thin where they are nearly plane. Component i
  /// of rows[k] is component k of axis i; four floats each, for vector registers. Larger than the triangles
  /// need by more than the rounding.
  struct alignas(16) OrientedBox {
    float rows[3][4] = {};
    float half[4] = {};    ///< [m]
    float center[4] = {};  ///< [m]
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  const OrientedBox& oriented_box(int node) const { return oriented_boxes_[static_cast<std::size_t>(node)]; }
  /// Triangle (index as in the mesh) at a place of the leaf order.
  int triangle_at(int place) const { return order_[static_cast<std::size_t>(place)]; }

 private:
  void build(int node, int first, int count, const std::vector<Vec3>& centers);
  void compute_dipoles();
  void compute_oriented_boxes();

  std::vector<TriangleCorners> corners_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  std::vector<Dipole> dipoles_;  ///< one a node
  std::vector<OrientedBox> oriented_boxes_;
  Box box_;
};

/// Whether two surfaces cross; b is posed in the frame of a by X_AB. A surface wholly inside the other does
/// not cross it.
bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB);

/// The nearest triangles of an earlier query of the same two surfaces: a good first guess after a small
/// motion.
struct PairHint {
  int triangle_a = -1;
  int triangle_b = -1;
};

/// Nearest pair of two surfaces, if nearer than max_distance. Cost: 5-50 us, less with a small bound or a
/// hint (which is updated; it does not change the distance).
ClosestPair closest_pair(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB,
                         double max_distance = std::numeric_limits<double>::infinity(),
                         PairHint* hint = nullptr);

/// Calls visit(pair) with the nearest points of every pair of triangles whose distance is at most
/// max_distance.
void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                          const std::function<void(const ClosestPair&)>& visit);

}  // namespace eigengrasp
