// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/shape/zernike_moments.hpp"

namespace eigengrasp {

/// The function on the unit ball whose Zernike moments describe a shape.
enum class ShapeFunction {
  surface,  ///< exp(-d^2 / (2 s^2)), d the distance to the surface, s = 0.14: any triangles
  solid,    ///< 1 inside, 0 outside
};

/// How the moments were integrated.
enum class DescriptorRoute {
  moments,  ///< exactly, over the triangles of a closed mesh
  voxels,   ///< over the cells of a grid
};

/// "surface", "solid"; "moments", "voxels".
const char* to_string(ShapeFunction function);
const char* to_string(DescriptorRoute route);
/// @throws Error for another name, listing these
ShapeFunction parse_shape_function(const std::string& name);

inline constexpr int kDescriptorOrder = 20;
inline constexpr std::size_t kDescriptorSize = 121;

/// A 3-D Zernike descriptor (Novotni and Klein 2003): the same wherever the shape is, however it is turned,
/// and whatever its size. Descriptors of different functions must not be compared.
struct ShapeDescriptor {
  std::vector<double> invariants;  ///< F_nl by n, then l (kDescriptorSize)
  /// The invariants times descriptor_weights(), made a vector of length 1. Distances are Euclidean, between
  /// these; at most sqrt(2).
  std::vector<float> values;
  ShapeFunction function = ShapeFunction::surface;
  DescriptorRoute route = DescriptorRoute::voxels;
  ShapeBall ball;  ///< what the unit ball was in the shape's frame [m]
};

struct DescriptorOptions {
  ShapeFunction function = ShapeFunction::surface;
  bool closed_by_moments = true;  ///< false: closed meshes on the grid as well
  bool allow_flat = false;        ///< a surface in a plane is described too
};

/// Surface: the ball is about the surface's centre of mass, with twice the root mean square distance from it
/// as radius; what is outside, and fades from 0.8 radii on, does not count. Always on the grid. Solid: the
/// ball is about the volume's centre, with the farthest vertex at 0.9 radii. By moments where the mesh is a
/// sound solid (MeshReport::solid), else on the grid, inside being where the generalised winding number is
/// above one half. Changes under rotation: below 0.3 % of the descriptor's length on the grid, 1e-6 by
/// moments. Cost, 5,000 triangles, one core: surface 20 ms; solid 10 to 20 ms by moments, 0.1 s
/// on the grid, and seconds where triangles are long and thin.
/// @throws Error for a mesh without triangles or area, numbers that are not finite, a surface in a plane
/// (unless allowed), or a solid that encloses nothing
ShapeDescriptor compute_shape_descriptor(const TriangleMesh& mesh, const DescriptorOptions& options = {});

/// The descriptor with these invariants, such as were stored. @throws Error where there are not
/// kDescriptorSize of them, they are not finite or negative, or all 0
ShapeDescriptor make_shape_descriptor(std::vector<double> invariants, ShapeFunction function,
                                      DescriptorRoute route, const ShapeBall& ball);

/// Euclidean distance of the values. @throws Error where the functions differ
double descriptor_distance(const ShapeDescriptor& a, const ShapeDescriptor& b);

/// What each invariant counts, in the order of ShapeDescriptor::invariants. Learned from the training half of
/// the Princeton Shape Benchmark; docs/theory/zernike.md.
const std::vector<double>& descriptor_weights();

}  // namespace eigengrasp
