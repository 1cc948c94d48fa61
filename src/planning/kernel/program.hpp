// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>

#include "core/lanes.hpp"

/// What the kernels read and write: a hand and what it can hit, flattened into plain arrays of single
/// precision. Lengths in metres, poses as row-major rotation and translation. Filled by StateEvaluator.
namespace eigengrasp::kernel {

/// One regular grid of distances inside a FieldView. Places of nodes are whole numbers in floats, exact below
/// most_words.
struct GridView {
  float origin[3];  ///< of node (0, 0, 0)
  float last[3];    ///< nodes - 1 along the axes
  float cell;
  float inverse_cell;
  float quantum;  ///< [m] of a unit of a distance that stands in the upper half of a word
  float row;      ///< nodes along x
  float layer;    ///< nodes along x times nodes along y
  float first;    ///< place of node (0, 0, 0) in the words
};
inline constexpr std::int32_t most_words = 1 << 24;

/// A distance field: a fine grid near the surface inside of a coarse one. A node is a word: its own distance
/// in the lower half, that of the next node along z in the upper one, both in sixteen bits with sign. So two
/// words side by side hold four corners of a cell, and half of the cache lines are touched.
struct FieldView {
  const std::int32_t* words;
  GridView fine;
  GridView coarse;
};

struct Transform {
  float R[9];
  float p[3];
};

/// Links that no joint moves against each other. The body's frame is that of its joint after the motion,
/// turned so that the joint's axis is z.
struct Body {
  std::int32_t parent;  ///< smaller than the body's own number; -1 for the base
  std::int32_t dof;     ///< that moves the joint
  bool slides;          ///< along z instead of turning about it
  float ratio, offset;  ///< joint value = ratio * dof + offset
  Transform in_parent;  ///< the joint's frame at value 0
};

/// Sixteen balls.
struct alignas(64) BallPack {
  float x[n_lanes], y[n_lanes], z[n_lanes];  ///< in the frame of the body
  float radius[n_lanes];                     ///< far below 0 for the ones that only fill up
};

/// The clusters of a core: of each of its packs of balls one ball, and how far the others are from it.
struct alignas(64) ClusterPack {
  float x[n_lanes], y[n_lanes], z[n_lanes];  ///< in the frame of the body
  float radius[n_lanes];
  float reach[n_lanes];  ///< all balls of the pack lie within this of the centre
};

/// A link with a surface: inner balls that cover it, and its own distance field.
struct Part {
  std::int32_t body;
  float center[3];          ///< of a ball about the whole part, in the body's frame
  float reach;              ///< its radius
  std::int32_t first_core;  ///< its balls belong to its cores
  std::int32_t n_cores;
  Transform body_in_link;  ///< from the body's frame to the frame of `field`
  FieldView field;
};

/// One of the inner balls of a part, which stands for all about it. Core k owns the kth pack of clusters, and
/// these the packs of balls 16 k to 16 k + 15.
struct CoreBall {
  float center[3];  ///< in the frame of the body
  std::int32_t body;
};

/// Sixteen cores.
struct alignas(64) CorePack {
  std::int32_t place[n_lanes];  ///< of lane 0 of the core's centre in Workspace::cores
  float radius[n_lanes];
  float reach[n_lanes];  ///< all balls that the core owns lie within this of its centre
};

struct Pair {
  std::int32_t balls, field;  ///< parts: balls of the first are looked up in the field of the second
};

struct Contact {
  std::int32_t body;
  float p[3], n[3];
};

/// Something fixed that the hand must not touch.
struct Solid {
  FieldView field;
  Transform object_in_field;  ///< from the object's frame to that of the field
};

/// Clearance of the hand from itself, which depends on its posture alone, over a grid of at most two
/// amplitudes: the least of distance minus radius over all balls of all pairs, up to `most_clearance`.
/// Negative: collides.
struct PostureGrid {
  const float* clearance;  ///< first amplitude fastest; null: there is none
  std::int32_t nodes[2];   ///< at least 2 along each; the second has no meaning for one amplitude
  float low[2];            ///< amplitudes of node (0, 0)
  float per_amplitude[2];  ///< nodes a unit of amplitude
};
inline constexpr float most_clearance = 0.004f;

/// Immutable; shared by all threads.
struct Program {
  std::int32_t n_dofs, n_amplitudes, n_bodies, n_parts, n_cores, n_pairs, n_contacts, n_obstacles;
  const float* origin;   ///< (n_dofs) of the eigengrasp space
  const float* basis;    ///< (n_dofs x n_amplitudes) row-major
  const float* dof_min;  ///< (n_dofs)
  const float* dof_max;
  float approach_point[3];  ///< of the hand base's frame, which is the frame of body 0
  const Body* bodies;
  const Part* parts;
  const CoreBall* cores;
  const CorePack* core_packs;
  const ClusterPack* clusters;
  const BallPack* balls;
  const Pair* pairs;
  const Contact* contacts;
  Solid object;
  const Solid* obstacles;
  PostureGrid postures;
  float refuse_depth;  ///< balls that intrude less are let pass
  float alpha;         ///< of eq. (6)
};

/// What became of a lane.
enum Verdict : std::int32_t {
  legal = 0,
  hits_object = 1,
  hits_itself = 2,
  hits_obstacle = 3,
  energy_too_high = 4
};

/// What is kept of each virtual contact: where it is in O, its normal there, distance, cosine; see
/// ContactApproach. Complete where the verdict is not energy_too_high.
inline constexpr int n_approach_rows = 8;

/// Sixteen states, and the memory to work on them.
struct Workspace {
  float* position;        ///< (3 x 16) of the approach point in O
  float* quaternion;      ///< (4 x 16) w, x, y, z of the hand base, unit length
  float* amplitudes;      ///< (n_amplitudes x 16)
  float* threshold;       ///< (16) states of a higher energy need not be told legal or not
  float* energy;          ///< (16) out; for verdict legal; a lower bound for energy_too_high
  std::int32_t* verdict;  ///< (16) out
  float* approaches;      ///< (n_contacts x n_approach_rows x 16) out; null: not wanted
  float* dofs;            ///< (n_dofs x 16) scratch
  float* poses;           ///< (n_bodies x 12 x 16) scratch
  float* centers;         ///< (n_parts x 3 x 16) scratch
  float* cores;           ///< (n_cores x 3 x 16) scratch
  std::uint32_t* near;    ///< (n_cores / 16, rounded up) scratch: cores of a state that are near the object
  float* row;             ///< (16) scratch
};

struct Range {
  float low, high, max_jump;
};

/// Where the variables of the search may be, and how far they jump.
struct SearchBox {
  float low[3], high[3];  ///< of the approach point in O
  float max_shift;        ///< of a coordinate
  float max_turn;         ///< of a component of the rotation vector [rad]
  std::int32_t n_amplitudes;
  const Range* amplitudes;
};

/// Where the sixteen lanes stand that neighbours are drawn of.
struct Chains {
  float* position;  ///< as in Workspace
  float* quaternion;
  float* amplitudes;
  float* energy;                  ///< (16)
  float* jump_temperature;        ///< (16) width T of the neighbourhood
  float* log_range;               ///< (16) log(1 + 1 / T)
  float* acceptance_temperature;  ///< (16) [energy]
  std::int32_t* random;           ///< (4 x 16) states of the random streams, not all zero
};

/// One variant of the kernels. All variants give the same bits.
struct Functions {
  /// Legality and contact energy, eqs. (6) and (7), of the sixteen states.
  void (*evaluate)(const Program&, const Workspace&);
  /// Draws a neighbour of each lane into the workspace, and the energy below which it is to be taken.
  void (*propose)(const SearchBox&, const Chains&, const Workspace&);
  /// The clearance that PostureGrid holds, of the sixteen states' amplitudes; written to `energy`.
  void (*clear_itself)(const Program&, const Workspace&);
};

extern const Functions baseline_functions;
extern const Functions avx2_functions;
extern const Functions avx512_functions;

}  // namespace eigengrasp::kernel
