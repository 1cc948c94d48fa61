// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lane_vectors.hpp"
#include "geometry/kernel/block_distances.hpp"

namespace eigengrasp::block_kernel {
namespace {

using kernel::Floats;
using kernel::Mask;
using kernel::splat;
using kernel::Vector;

/// A convex body whose point nearest to the centre is d away in direction n is at least d + n . y away from a
/// point at y from the centre.
template <class B>
int keep(const Surface& surface, const Ball& ball, const std::int32_t* boxes, int n, std::int32_t* kept) {
  using F = Floats<B>;
  static_assert(sizeof(LeafBox) == 6 * sizeof(float));
  const float* const corners = surface.boxes[0].min;
  const F zero(0.0f);
  const float bound = (ball.distance + 2.0f * ball.radius) * 1.00001f + surface.rounding;
  int n_kept = 0;
  for (int first = 0; first < n; first += n_lanes) {
    const int here = n - first < n_lanes ? n - first : n_lanes;
    alignas(64) std::int32_t box[n_lanes];
    for (int l = 0; l < n_lanes; ++l) box[l] = boxes[first + (l < here ? l : 0)];
    const kernel::Ints<B> at = kernel::load_ints<B>(box) * kernel::Ints<B>(6);
    const auto off = [&](int k) {  // from the nearest point of the box to the centre
      const F c(ball.center[k]);
      return c - min(max(c, kernel::gather<B>(corners + k, at)), kernel::gather<B>(corners + 3 + k, at));
    };
    const Vector<B> v{off(0), off(1), off(2)};
    const F d2 = dot(v, v);
    const F d = sqrt(d2);
    const F lead = d - F(ball.distance + ball.slack + surface.rounding);
    const F turned = max(d - dot(v, splat<B>(ball.direction)), zero) + F(1e-5f) * d;
    const Mask<B> may = (lead <= zero) | (lead * lead * d <= F(2.0f * ball.radius * ball.radius) * turned);
    std::uint32_t lanes = bits(may & (d <= F(bound))) & (here < n_lanes ? (1u << here) - 1 : 0xffffu);
    for (; lanes != 0; lanes &= lanes - 1) kept[n_kept++] = box[__builtin_ctz(lanes)];
  }
  return n_kept;
}

/// Squared distance of d from a segment that starts at the origin and goes along e.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> segment_distance2(const Vector<B>& d, const float* e, float per_e2) {
  const Vector<B> along = splat<B>(e);
  const Floats<B> t = kernel::clamp(dot(d, along) * Floats<B>(per_e2), Floats<B>(0.0f), Floats<B>(1.0f));
  const Vector<B> r = d - t * along;
  return dot(r, r);
}

template <class B>
EIGENGRASP_LANES_INLINE Floats<B> triangle_distance2(const Triangle& t, const Vector<B>& p) {
  using F = Floats<B>;
  const Vector<B> from_a = p - splat<B>(t.a);
  const Vector<B> from_b = from_a - splat<B>(t.ab);
  const Vector<B> from_c = from_a + splat<B>(t.ca);
  const F edges =
      min(min(segment_distance2(from_a, t.ab, t.per_ab2), segment_distance2(from_b, t.bc, t.per_bc2)),
          segment_distance2(from_c, t.ca, t.per_ca2));
  const F zero(0.0f);
  const F inside = min(min(dot(from_a, splat<B>(t.in_ab)), dot(from_b, splat<B>(t.in_bc))),
                       min(dot(from_c, splat<B>(t.in_ca)), zero));
  const F height = dot(from_a, splat<B>(t.normal));
  return min(edges, height * height - F(much) * inside + F(t.no_face));
}

/// First the corners, which bound all distances from above, then the triangles of leaves that may matter.
template <class B>
void measure(const Surface& surface, const std::int32_t* leaves, int n, Nodes& nodes, float* scratch) {
  using F = Floats<B>;
  const Vector<B> p{kernel::load<B>(nodes.x), kernel::load<B>(nodes.y), kernel::load<B>(nodes.z)};
  F bound(much);
  for (int i = 0; i < n; ++i) {
    const Leaf& leaf = surface.leaves[leaves[i]];
    F nearest(much);
    for (std::int32_t c = leaf.first_corner; c < leaf.first_corner + leaf.n_corners; ++c) {
      const Vector<B> d = p - splat<B>(surface.corners[c]);
      nearest = min(nearest, dot(d, d));
    }
    kernel::store(scratch + i * n_lanes, nearest);
    bound = min(bound, nearest);
  }
  F best(much);
  kernel::Ints<B> triangle = kernel::load_ints<B>(nodes.triangle);
  for (int i = 0; i < n; ++i) {
    const Leaf& leaf = surface.leaves[leaves[i]];
    // Where no point of a leaf's triangles is farther than reach from all its corners (the foot of the
    // perpendicular on a face or edge: Pythagoras).
    const F lead = kernel::load<B>(scratch + i * n_lanes) * F(0.99999f) - F(leaf.reach2);
    if (bits(lead <= bound) == 0) continue;
    for (std::int32_t t = leaf.first; t < leaf.first + leaf.count; ++t) {
      const F d2 = triangle_distance2(surface.triangles[t], p);
      const Mask<B> nearer = d2 < best;
      best = min(best, d2);
      triangle = select(nearer, kernel::Ints<B>(t), triangle);
    }
    bound = min(bound, best);
  }
  kernel::store(nodes.distance2, best);
  kernel::store_ints(nodes.triangle, triangle);
}

}  // namespace
}  // namespace eigengrasp::block_kernel
