// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lanes.hpp"

/// Distances of sixteen grid nodes from triangles, in single precision. Plain data, as the kernels of each
/// instruction set take it.
namespace eigengrasp::block_kernel {

using kernel::n_lanes;

inline constexpr float much = 1e20f;

/// What the distance to a triangle takes.
struct Triangle {
  float a[3];                          ///< a corner, from the origin of all
  float ab[3], bc[3], ca[3];           ///< edges
  float per_ab2, per_bc2, per_ca2;     ///< one over the squared lengths; 0 for none
  float normal[3];                     ///< of the face, unit; 0 where it is a needle
  float in_ab[3], in_bc[3], in_ca[3];  ///< unit vectors in the face, from the edges inwards
  float no_face;                       ///< added to the squared distance of the face: `much` for a needle
};

/// Some triangles that lie together.
struct Leaf {
  std::int32_t first_corner;  ///< of Surface::corners: each once
  std::int32_t n_corners;
  std::int32_t first;  ///< of Surface::triangles
  std::int32_t count;
  float reach2;  ///< no point of the triangles is farther [m^2] from all their corners
};

/// About the triangles of a leaf, corners from the origin of all; wider than they are by what rounding may
/// be.
struct LeafBox {
  float min[3];
  float max[3];
};

/// Points within `radius` of a centre, and the distance of one point q of the surface from that.
struct Ball {
  float center[3];
  float radius;
  float distance;      ///< of q
  float direction[3];  ///< from q to the centre, unit
  float slack;  ///< from a point at y from the centre, q is at most distance + direction . y + slack away
};

struct Surface {
  const Triangle* triangles;
  const float (*corners)[3];
  const Leaf* leaves;
  const LeafBox* boxes;  ///< one a leaf
  float rounding;        ///< [m] more than single precision may be off
};

struct alignas(64) Nodes {
  float x[n_lanes], y[n_lanes], z[n_lanes];  ///< from the origin of all [m]
  float distance2[n_lanes];                  ///< out: squared distance from the nearest triangle [m^2]
  std::int32_t triangle[n_lanes];            ///< out: its place in Surface::triangles; as it was where `much`
};

struct Functions {
  /// Those of the boxes that may hold the point of the surface that is nearest to some point of the ball.
  /// @param kept out, room for n + 16 @return their number  @pre ball.distance > 1.5 ball.radius
  int (*keep)(const Surface& surface, const Ball& ball, const std::int32_t* boxes, int n, std::int32_t* kept);
  /// The nearest triangle of each node among those of the leaves.
  /// @param scratch 16 floats a leaf, aligned to 64 bytes
  void (*measure)(const Surface& surface, const std::int32_t* leaves, int n, Nodes& nodes, float* scratch);
};

/// All variants give the same bits.
extern const Functions baseline_functions;
extern const Functions avx2_functions;
extern const Functions avx512_functions;

}  // namespace eigengrasp::block_kernel
