// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp {

/// A shape ready to be aligned with others. Immutable, shared by all threads. All of it is of the surface, so
/// that closed meshes, soups and scans are treated alike.
struct AlignmentShape {
  MeshBvh bvh;                        ///< in the shape's own frame [m]
  Vec3 center = Vec3::Zero();         ///< area-weighted centre of mass [m]
  double size = 0.0;                  ///< root of the mean squared distance from the centre [m]
  Mat3 axes = Mat3::Identity();       ///< principal axes, right-handed; by falling variance
  Vec3 deviations = Vec3::Zero();     ///< standard deviations along them over the size, falling
  std::vector<Vec3> points, normals;  ///< spread evenly over the area, always the same; (p - center) / size
  std::vector<Vec3> seen;             ///< of a scan: likewise, over what was seen; else empty
};

/// Cost: about 1.5 us a triangle. @throws Error for an empty mesh, numbers that are not finite, or a
/// surface without area
AlignmentShape make_alignment_shape(const TriangleMesh& mesh);

/// A scan: one-sided alignments from it to other shapes ask only where the part lies that was seen.
/// @param seen part of the mesh's surface, which is guessed elsewhere. Cost and errors as above
AlignmentShape make_alignment_shape(const TriangleMesh& mesh, const TriangleMesh& seen);

/// How one shape is laid upon another: the point p of the model goes to
///   center_target + scale * R * (p - center_model).
struct Alignment {
  std::string method;                 ///< kPcaAlignment or kIcpAlignment
  Mat3 R = Mat3::Identity();          ///< a proper rotation, never a reflection
  Vec3 center_model = Vec3::Zero();   ///< [m]
  Vec3 center_target = Vec3::Zero();  ///< [m]
  double scale = 1.0;                 ///< that makes the sizes equal
  /// Correlation of the two surfaces after smoothing (Zernike moments to order 10): 1 for equal ones.
  double overlap = 0.0;
  /// Root mean square distance of the surfaces, both ways, over the target's size.
  double distance = 0.0;
  int candidates = 0;  ///< rotations that were compared

  /// X_target_model with this scale, such as Alignment::scale, or 1 where both keep their sizes.
  Eigen::Matrix4d matrix(double with_scale) const;
};

/// The way back: from the target to the model.
Alignment inverse(const Alignment& alignment);

inline constexpr const char* kPcaAlignment = "pca";
inline constexpr const char* kIcpAlignment = "pca-icp";

struct AlignmentOptions {
  /// Deviations of two axes whose ratio is below this count as equal: then quarter turns are tried as well.
  double equal_axes = 1.15;  ///< >= 1
  bool match_scale = true;   ///< else both keep their sizes, and Alignment::scale is 1
  // Of icp alone:
  int seeds = 4;           ///< best rotations that are refined, >= 1
  int iterations = 12;     ///< of each, >= 1
  bool one_sided = false;  ///< only from the model, or what was seen of it, to the target
};

/// Principal axes upon principal axes, centre upon centre. Axes have no sense of direction: the 4 proper
/// choices of signs, and up to 24 rotations where axes are about equal, are compared by their overlap. Cost:
/// about 0.05 ms a rotation, and 1 ms for the distance.
Alignment align_by_pca(const AlignmentShape& model, const AlignmentShape& target,
                       const AlignmentOptions& options = {});

/// The best rotations of align_by_pca (with eighth turns where axes are about equal), each refined by
/// iterative closest points (point to plane, Chen and Medioni 1992); the one with the least distance, which
/// is never worse than that of align_by_pca. Cost: 10-30 ms.
Alignment align_by_icp(const AlignmentShape& model, const AlignmentShape& target,
                       const AlignmentOptions& options = {});

}  // namespace eigengrasp
