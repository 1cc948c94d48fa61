// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Blocks of nodes are halved three times, from 8^3 to 2^3 nodes; each keeps the parts of the hierarchy that
// may hold the triangle nearest to one of its nodes, and the smallest blocks measure those triangles from all
// their nodes at once, in single precision. The nearest one is then measured in double precision.
#include "geometry/grid_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "eigengrasp/core/parallel.hpp"

namespace eigengrasp {

namespace {

using Place = Eigen::Vector3i;
using Vec3f = Eigen::Vector3f;
constexpr std::size_t lanes = 8;  // nodes of the smallest block

/// Of the eight parts of a block, x fastest.
Place corner_place(int k) {
  return {k & 1, k >> 1 & 1, k >> 2};
}

/// What the distance to a triangle takes, but for where it is.
struct TriangleShape {
  Vec3f ab, bc, ca;
  float per_ab2, per_bc2, per_ca2;  ///< one over the squared lengths; 0 for none
  Vec3f normal;                     ///< of the face; 0 where it is a needle
  Vec3f in_ab, in_bc, in_ca;        ///< unit vectors in the face, from the edges inwards
  float no_face;                    ///< added to the squared distance of the face: much where it is a needle
};

constexpr float much = 1e20F;

float one_over_square(const Vec3& v) {
  const double square = v.squaredNorm();
  return square > 1e-30 ? static_cast<float>(1.0 / square) : 0.0F;
}

TriangleShape shape_of(const TriangleCorners& t) {
  const Vec3 ab = t.b - t.a;
  const Vec3 bc = t.c - t.b;
  const Vec3 ca = t.a - t.c;
  TriangleShape s;
  s.ab = ab.cast<float>();
  s.bc = bc.cast<float>();
  s.ca = ca.cast<float>();
  s.per_ab2 = one_over_square(ab);
  s.per_bc2 = one_over_square(bc);
  s.per_ca2 = one_over_square(ca);
  s.normal = s.in_ab = s.in_bc = s.in_ca = Vec3f::Zero();
  s.no_face = much;
  const Vec3 n = ab.cross(-ca);
  const double longest2 = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  if (!(n.norm() > 1e-5 * longest2)) return s;
  const Vec3 unit = n.normalized();
  s.normal = unit.cast<float>();
  s.in_ab = unit.cross(ab).normalized().cast<float>();
  s.in_bc = unit.cross(bc).normalized().cast<float>();
  s.in_ca = unit.cross(ca).normalized().cast<float>();
  s.no_face = 0.0F;
  return s;
}

/// The surface as the smallest blocks need it.
struct Leaves {
  struct Range {
    int first = 0;  ///< of corners
    int count = 0;
    float reach2 = 0.0F;  ///< no point of the triangles is farther [m^2] from all their corners
  };
  Vec3 origin;                        ///< of the corners, so that single precision suffices
  std::vector<TriangleShape> shapes;  ///< one a triangle
  std::vector<Range> ranges;          ///< one a node of the hierarchy
  std::vector<Vec3f> corners;         ///< of the triangles of a leaf, each once

  explicit Leaves(const MeshBvh& bvh) : origin(bvh.box().center()), ranges(bvh.nodes().size()) {
    for (int t = 0; t < bvh.triangle_count(); ++t) shapes.push_back(shape_of(bvh.corners(t)));
    for (std::size_t n = 0; n < ranges.size(); ++n) {
      const MeshBvh::Node& node = bvh.nodes()[n];
      ranges[n].first = static_cast<int>(corners.size());
      for (int i = node.left; i < node.left + node.count; ++i)
        add(bvh.corners(bvh.triangle_at(i)), ranges[n]);
    }
  }

 private:
  void add(const TriangleCorners& t, Range& range) {
    for (const Vec3* p : {&t.a, &t.b, &t.c}) {
      const Vec3f corner = (*p - origin).cast<float>();
      if (std::find(corners.begin() + range.first, corners.end(), corner) == corners.end())
        corners.push_back(corner);
    }
    range.count = static_cast<int>(corners.size()) - range.first;
    const double longest2 =
        std::max({(t.b - t.a).squaredNorm(), (t.c - t.b).squaredNorm(), (t.a - t.c).squaredNorm()});
    range.reach2 = std::max(range.reach2, static_cast<float>(longest2 / 3.0));
  }
};

// Four nodes at a time (vector extension of GCC and Clang).
using Floats = float __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(16)));

struct Floats3 {
  Floats x, y, z;
  Floats dot(const Vec3f& v) const { return x * v[0] + y * v[1] + z * v[2]; }
  Floats3 plus(const Vec3f& v) const { return {x + v[0], y + v[1], z + v[2]}; }
};

Floats smaller(Floats a, Floats b) {
  return a < b ? a : b;
}

/// Squared distance of d from a segment that starts at the origin and goes along e.
Floats segment_distance2(const Floats3& d, const Vec3f& e, float per_e2) {
  Floats t = d.dot(e) * per_e2;
  t = t > 0.0F ? t : Floats{};
  t = t < 1.0F ? t : Floats{} + 1.0F;
  const Floats3 r{d.x - t * e[0], d.y - t * e[1], d.z - t * e[2]};
  return r.x * r.x + r.y * r.y + r.z * r.z;
}

/// Squared distances from a triangle of points with coordinates from its corner a.
Floats triangle_distance2(const TriangleShape& s, const Floats3& from_a) {
  const Floats3 from_b = from_a.plus(-s.ab);
  const Floats3 from_c = from_a.plus(s.ca);
  const Floats edges =
      smaller(smaller(segment_distance2(from_a, s.ab, s.per_ab2), segment_distance2(from_b, s.bc, s.per_bc2)),
              segment_distance2(from_c, s.ca, s.per_ca2));
  const Floats inside =
      smaller(smaller(from_a.dot(s.in_ab), from_b.dot(s.in_bc)), smaller(from_c.dot(s.in_ca), Floats{}));
  const Floats height = from_a.dot(s.normal);
  return smaller(edges, height * height - much * inside + s.no_face);
}

/// The eight nodes of a smallest block, from its centre, and their nearest triangles so far.
class BlockNodes {
 public:
  BlockNodes(double cell, int guess) {
    const auto half = static_cast<float>(0.5 * cell);
    for (std::size_t h = 0; h < 2; ++h) {
      at_[h].x = Floats{-half, half, -half, half};
      at_[h].y = Floats{-half, -half, half, half};
      at_[h].z = Floats{} + (h == 0 ? -half : half);
      distance2_[h] = Floats{} + much;
      bound_[h] = Floats{} + much;
      triangle_[h] = Ints{} + guess;
    }
  }
  /// @param a corner of the triangle from the centre
  void measure(const TriangleShape& shape, int triangle, const Vec3f& a) {
    for (std::size_t h = 0; h < 2; ++h) {
      const Floats d2 = triangle_distance2(shape, at_[h].plus(-a));
      triangle_[h] = d2 < distance2_[h] ? Ints{} + triangle : triangle_[h];
      distance2_[h] = smaller(d2, distance2_[h]);
    }
  }
  /// Squared distances to the nearest of the corners, which bound the distance to the surface from above.
  std::array<Floats, 2> measure_corners(const Vec3f* corners, int count, const Vec3f& center) {
    std::array<Floats, 2> nearest = {Floats{} + much, Floats{} + much};
    for (int i = 0; i < count; ++i)
      for (std::size_t h = 0; h < 2; ++h) {
        const Floats3 d = at_[h].plus(center - corners[i]);
        nearest[h] = smaller(nearest[h], d.x * d.x + d.y * d.y + d.z * d.z);
      }
    for (std::size_t h = 0; h < 2; ++h) bound_[h] = smaller(bound_[h], nearest[h]);
    return nearest;
  }
  /// Whether triangles with these distances of their corners, and no point farther than reach from those, may
  /// be nearest. (The foot of the perpendicular on a face or edge: Pythagoras.)
  bool may_be_nearest(const std::array<Floats, 2>& corners, float reach2) const {
    for (std::size_t h = 0; h < 2; ++h) {
      const Floats lead = corners[h] * 0.99999F - reach2 - bound_[h];
      for (std::size_t l = 0; l < 4; ++l)
        if (lead[l] <= 0.0F) return true;
    }
    return false;
  }
  int triangle(std::size_t lane) const { return triangle_[lane / 4][lane % 4]; }
  double distance2(std::size_t lane) const { return static_cast<double>(distance2_[lane / 4][lane % 4]); }

 private:
  std::array<Floats3, 2> at_;
  std::array<Floats, 2> distance2_;
  std::array<Floats, 2> bound_;
  std::array<Ints, 2> triangle_;
};

/// Tells which boxes may hold the point of the surface that is nearest to some point within `radius` of
/// `center`, given one point q of the surface.
class NearnessTest {
 public:
  NearnessTest(const Vec3& center, double radius, const Vec3& q) : center_(center), radius_(radius) {
    const Vec3 d = center - q;
    distance_ = d.norm();
    const double bound = distance_ + 2.0 * radius;
    bound2_ = bound * bound;
    far_ = distance_ > 1.5 * radius;
    if (!far_) return;
    direction_ = d / distance_;
    slack_ = radius * radius / (2.0 * (distance_ - radius));
  }

  // At y from the centre, the point q is at most distance + direction . y + slack away, and a convex body
  // whose point nearest to the centre is d away in direction n is at least d + n . y away.
  bool may_hold(const Box& box) const {
    const Vec3 v = center_ - center_.cwiseMax(box.min).cwiseMin(box.max);
    const double d2 = v.squaredNorm();
    if (d2 > bound2_) return false;
    if (!far_ || d2 <= distance_ * distance_) return true;
    const double d = std::sqrt(d2);
    const double lead = d - distance_ - slack_;
    return lead <= 0.0 || lead * lead * d <= 2.0 * radius_ * radius_ * (d - v.dot(direction_)) + 1e-18;
  }

 private:
  Vec3 center_;
  double radius_;
  double distance_ = 0.0;
  double bound2_ = 0.0;
  bool far_ = false;
  Vec3 direction_ = Vec3::Zero();
  double slack_ = 0.0;
};

class BlockFill {
 public:
  BlockFill(const MeshBvh& bvh, const Leaves& leaves, FieldGrid& grid)
      : bvh_(bvh), leaves_(leaves), grid_(grid) {}

  void run(const Place& first) {
    parts_.assign(1, 0);
    fill(first, 8, 0, 0);
  }

 private:
  Vec3 position(const Place& node) const { return grid_.origin + grid_.cell * node.cast<double>(); }

  /// @param begin of the block's list of parts of the hierarchy, up to the end of parts_
  /// @param guess a triangle nearby
  void fill(const Place& first, int size, std::size_t begin, int guess) {
    if ((first.array() >= grid_.nodes.array()).any()) return;
    const std::size_t end = parts_.size();
    const Vec3 center = position(first) + Vec3::Constant(0.5 * (size - 1) * grid_.cell);
    const double radius = 0.5 * std::sqrt(3.0) * (size - 1) * grid_.cell * (1.0 + 1e-9);
    const Vec3 near = nearest_of(center, size, begin, guess);
    const NearnessTest test(center, radius, near);
    keep(test, begin, end, size > 2 ? radius : 0.0);
    if (size == 2) {
      measure_block(first, center, end, guess);
    } else {
      for (int k = 0; k < 8; ++k) fill(first + size / 2 * corner_place(k), size / 2, end, guess);
    }
    parts_.resize(end);
  }

  /// A point of the surface near the centre of a block, of the triangle that `guess` is set to: the nearest,
  /// for large blocks.
  Vec3 nearest_of(const Vec3& center, int size, std::size_t begin, int& guess) const {
    Vec3 q = closest_point_on_triangle(bvh_.corners(guess), center);
    double d2 = (center - q).squaredNorm();
    const auto try_triangle = [&](int t) {
      const Vec3 p = closest_point_on_triangle(bvh_.corners(t), center);
      if ((center - p).squaredNorm() >= d2) return;
      d2 = (center - p).squaredNorm();
      q = p;
      guess = t;
    };
    if (size > 2) {
      const ClosestPoint nearer = bvh_.closest_point(center, std::sqrt(d2));
      if (nearer.triangle >= 0) try_triangle(nearer.triangle);
      return q;
    }
    int best = -1;
    double best2 = d2;
    for (std::size_t i = begin; i < parts_.size(); ++i) {
      const MeshBvh::Node& node = bvh_.nodes()[static_cast<std::size_t>(parts_[i])];
      const double box2 = (center - center.cwiseMax(node.box.min).cwiseMin(node.box.max)).squaredNorm();
      if (node.count == 0 || box2 >= best2) continue;
      best2 = box2;
      best = parts_[i];
    }
    if (best < 0) return q;
    const MeshBvh::Node& leaf = bvh_.nodes()[static_cast<std::size_t>(best)];
    for (int i = leaf.left; i < leaf.left + leaf.count; ++i) try_triangle(bvh_.triangle_at(i));
    return q;
  }

  /// Adds the parts of [begin, end) that pass the test, opened until none is larger than `largest`.
  void keep(const NearnessTest& test, std::size_t begin, std::size_t end, double largest) {
    for (std::size_t i = begin; i < end; ++i) {
      open_.assign(1, parts_[i]);
      while (!open_.empty()) {
        const int part = open_.back();
        open_.pop_back();
        const MeshBvh::Node& node = bvh_.nodes()[static_cast<std::size_t>(part)];
        if (!test.may_hold(node.box)) continue;
        if (node.count == 0 && node.box.size().squaredNorm() > largest * largest) {
          open_.push_back(node.left + 1);
          open_.push_back(node.left);
        } else {
          parts_.push_back(part);
        }
      }
    }
  }

  void measure_block(const Place& first, const Vec3& center, std::size_t begin, int guess) {
    BlockNodes nodes(grid_.cell, guess);
    const Vec3f center_f = (center - leaves_.origin).cast<float>();
    corner_distances_.clear();
    for (std::size_t i = begin; i < parts_.size(); ++i) {
      const Leaves::Range& range = leaves_.ranges[static_cast<std::size_t>(parts_[i])];
      corner_distances_.push_back(
          nodes.measure_corners(leaves_.corners.data() + range.first, range.count, center_f));
    }
    for (std::size_t i = begin; i < parts_.size(); ++i) {
      const auto part = static_cast<std::size_t>(parts_[i]);
      if (!nodes.may_be_nearest(corner_distances_[i - begin], leaves_.ranges[part].reach2)) continue;
      const MeshBvh::Node& leaf = bvh_.nodes()[part];
      for (int k = leaf.left; k < leaf.left + leaf.count; ++k) {
        const int t = bvh_.triangle_at(k);
        nodes.measure(leaves_.shapes[static_cast<std::size_t>(t)], t,
                      (bvh_.corners(t).a - center).cast<float>());
      }
    }
    for (std::size_t l = 0; l < lanes; ++l) store(first, l, nodes);
  }

  void store(const Place& first, std::size_t lane, const BlockNodes& nodes) {
    const Place node = first + corner_place(static_cast<int>(lane));
    if ((node.array() >= grid_.nodes.array()).any()) return;
    const Vec3 p = position(node);
    double distance = (closest_point_on_triangle(bvh_.corners(nodes.triangle(lane)), p) - p).norm();
    // Should single precision have been misled by a bad triangle, the whole surface is asked.
    if (std::abs(std::sqrt(nodes.distance2(lane)) - distance) > 1e-5 * distance + 1e-7)
      distance = std::min(distance, bvh_.closest_point(p, distance).distance);
    const auto nx = static_cast<std::size_t>(grid_.nodes.x());
    const auto ny = static_cast<std::size_t>(grid_.nodes.y());
    grid_.values[(static_cast<std::size_t>(node.z()) * ny + static_cast<std::size_t>(node.y())) * nx +
                 static_cast<std::size_t>(node.x())] = static_cast<float>(distance);
  }

  const MeshBvh& bvh_;
  const Leaves& leaves_;
  FieldGrid& grid_;
  std::vector<int> parts_;  ///< a stack of lists, one a level
  std::vector<int> open_;
  std::vector<std::array<Floats, 2>> corner_distances_;  ///< one a leaf of the smallest block
};

}  // namespace

void fill_unsigned_distances(const MeshBvh& bvh, FieldGrid& grid, int threads) {
  const Leaves leaves(bvh);
  const Place blocks = (grid.nodes.array() + 7) / 8;
  parallel_for(static_cast<std::size_t>(blocks.y() * blocks.z()), threads, [&](std::size_t row, int) {
    BlockFill fill(bvh, leaves, grid);
    const auto y = static_cast<int>(row) % blocks.y();
    const auto z = static_cast<int>(row) / blocks.y();
    for (int x = 0; x < blocks.x(); ++x) fill.run(8 * Place(x, y, z));
  });
}

}  // namespace eigengrasp
