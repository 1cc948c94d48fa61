// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::modeling {

/// Moves every vertex onto the zero set by Newton steps along the gradient, each at most max_step [m]. A move
/// is left out where it would turn a triangle over or make it a sliver.
void project(TriangleMesh& mesh, const Solid& solid, double max_step, int iterations = 3, int n_threads = 0);

/// `iterations` rounds of: every vertex goes part of the way to the mean of its neighbours along the surface,
/// then back onto the zero set. Makes triangles more even. A step is left out where it would turn a triangle
/// over or make it a sliver. Only vertices with a triangle worse than below_quality move (see
/// triangle_quality; 1: all).
void relax(TriangleMesh& mesh, const Solid& solid, double max_step, int iterations, int n_threads = 0,
           double below_quality = 1.0);

/// One pass that swaps the edge between two triangles for the other diagonal where the worse of both gets
/// better and neither turns by more than min_cosine allows against the surface of the pair. Returns the
/// number of flips; call it a few times, in turn with relax().
/// @pre the mesh is closed and manifold; it stays so.
std::size_t flip_edges(TriangleMesh& mesh, double min_cosine = 0.985);

/// Moves vertices that lie beside a sharp edge or corner of the zero set onto it (quadric of the tangent
/// planes around); others stay. reach [m] is the largest move.
void sharpen(TriangleMesh& mesh, const Solid& solid, double reach, int n_threads = 0);

/// 4 sqrt(3) area / sum of squared edges [-]: 1 for an equilateral triangle, 0 for a flat one.
double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c);

/// What a mesh is like; see problems().
struct MeshReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  bool closed = false;             ///< every edge belongs to two triangles, in opposite directions
  bool manifold_vertices = false;  ///< the triangles around every vertex form one fan
  int components = 0;
  int euler_characteristic = 0;   ///< V - E + F; 2 sphere, 0 torus
  double volume = 0.0;            ///< [m^3], positive where outward
  double area = 0.0;              ///< [m^2]
  double min_area = 0.0;          ///< of a triangle [m^2]
  double min_quality = 0.0;       ///< of a triangle, 1 equilateral, 0 flat
  double longest_edge = 0.0;      ///< [m]
  Vec3 first_cut = Vec3::Zero();  ///< where the first such pair is [m]
  std::size_t intersections = 0;  ///< pairs of triangles that cut each other (shared corners and edges apart)
};

MeshReport inspect(const TriangleMesh& mesh);

/// Sentences that say what is wrong: open, not manifold, inside out, more than one component, another Euler
/// characteristic, empty triangles, self-intersection. Empty where all is well.
std::vector<std::string> problems(const MeshReport& report, int expected_euler_characteristic = 2);

/// Wavefront OBJ, one v line per vertex with so many decimals and one f line per triangle. Written
/// atomically.
/// @throws Error where it cannot be written.
void save_obj(const TriangleMesh& mesh, const std::filesystem::path& file, int decimals = 6,
              const std::string& comment = {});

}  // namespace eigengrasp::modeling
