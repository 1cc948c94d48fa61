// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Blocks of nodes are divided twice, from 8^3 nodes to 4^3 and to columns of 2 x 2 x 4; each keeps the parts
// of the hierarchy that may hold the triangle nearest to one of its nodes, and the columns measure those
// triangles from their sixteen nodes at once, in single precision. The nearest one is then measured in double
// precision.
#include "geometry/grid_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/variants.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "geometry/kernel/block_distances.hpp"

namespace eigengrasp {

namespace {

using Place = Eigen::Vector3i;
using block_kernel::Leaf;
using block_kernel::LeafBox;
using block_kernel::Triangle;
using kernel::n_lanes;

void put(const Vec3& v, float (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(v[k]);
}

float one_over_square(const Vec3& v) {
  const double square = v.squaredNorm();
  return square > 1e-30 ? static_cast<float>(1.0 / square) : 0.0F;
}

Triangle flattened(const TriangleCorners& t, const Vec3& origin) {
  const Vec3 ab = t.b - t.a;
  const Vec3 bc = t.c - t.b;
  const Vec3 ca = t.a - t.c;
  Triangle s{};
  put(t.a - origin, s.a);
  put(ab, s.ab);
  put(bc, s.bc);
  put(ca, s.ca);
  s.per_ab2 = one_over_square(ab);
  s.per_bc2 = one_over_square(bc);
  s.per_ca2 = one_over_square(ca);
  s.no_face = block_kernel::much;
  const Vec3 n = ab.cross(-ca);
  const double longest2 = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  if (!(n.norm() > 1e-5 * longest2)) return s;
  const Vec3 unit = n.normalized();
  put(unit, s.normal);
  put(unit.cross(ab).normalized(), s.in_ab);
  put(unit.cross(bc).normalized(), s.in_bc);
  put(unit.cross(ca).normalized(), s.in_ca);
  s.no_face = 0.0F;
  return s;
}

/// The surface as the smallest blocks need it.
struct Flattened {
  Vec3 origin;                      ///< of all places, so that single precision suffices
  std::vector<Triangle> triangles;  ///< in the order of the hierarchy's leaves
  std::vector<Leaf> leaves;         ///< one a node of the hierarchy
  std::vector<LeafBox> boxes;       ///< as the leaves
  std::vector<std::array<float, 3>> corners;
  double rounding;  ///< [m] more than single precision may be off

  explicit Flattened(const MeshBvh& bvh)
      : origin(bvh.box().center()),
        leaves(bvh.nodes().size()),
        boxes(leaves.size()),
        rounding(1e-6 * bvh.box().diagonal()) {
    for (int i = 0; i < bvh.triangle_count(); ++i)
      triangles.push_back(flattened(bvh.corners(bvh.triangle_at(i)), origin));
    for (std::size_t n = 0; n < leaves.size(); ++n) {
      const MeshBvh::Node& node = bvh.nodes()[n];
      put(node.box.min - origin - Vec3::Constant(rounding), boxes[n].min);
      put(node.box.max - origin + Vec3::Constant(rounding), boxes[n].max);
      leaves[n] = {static_cast<int>(corners.size()), 0, node.left, node.count, 0.0F};
      for (int i = node.left; i < node.left + node.count; ++i)
        add(bvh.corners(bvh.triangle_at(i)), leaves[n]);
    }
  }

  block_kernel::Surface view() const {
    return {triangles.data(), reinterpret_cast<const float(*)[3]>(corners.data()), leaves.data(),
            boxes.data(), static_cast<float>(std::max(2e-6, rounding))};
  }

 private:
  void add(const TriangleCorners& t, Leaf& leaf) {
    for (const Vec3* p : {&t.a, &t.b, &t.c}) {
      const Vec3 d = *p - origin;
      const std::array<float, 3> corner{static_cast<float>(d.x()), static_cast<float>(d.y()),
                                        static_cast<float>(d.z())};
      if (std::find(corners.begin() + leaf.first_corner, corners.end(), corner) == corners.end())
        corners.push_back(corner);
    }
    leaf.n_corners = static_cast<int>(corners.size()) - leaf.first_corner;
    const double longest2 =
        std::max({(t.b - t.a).squaredNorm(), (t.c - t.b).squaredNorm(), (t.a - t.c).squaredNorm()});
    leaf.reach2 = std::max(leaf.reach2, static_cast<float>(longest2 / 3.0));
  }
};

/// Points within `radius` of `center`, and one point q of the surface: what tells which boxes may hold the
/// point of the surface that is nearest to one of them.
class Nearness {
 public:
  Nearness(const Vec3& center, double radius, const Vec3& q)
      : center_(center), radius_(radius), from_q_(center - q), distance_(from_q_.norm()) {}

  /// Whether q is so far that directions tell.
  bool far() const { return distance_ > 1.5 * radius_; }
  /// As the kernel asks. @param origin of all places there  @pre far()
  block_kernel::Ball in_lanes(const Vec3& origin) const {
    block_kernel::Ball ball{};
    put(center_ - origin, ball.center);
    put(from_q_ / distance_, ball.direction);
    ball.radius = static_cast<float>(radius_);
    ball.distance = static_cast<float>(distance_);
    ball.slack = static_cast<float>(radius_ * radius_ / (2.0 * (distance_ - radius_)));
    return ball;
  }

  /// By distances alone.
  bool may_hold(const Box& box) const {
    const double bound = distance_ + 2.0 * radius_;
    return (center_ - center_.cwiseMax(box.min).cwiseMin(box.max)).squaredNorm() <= bound * bound;
  }

 private:
  Vec3 center_;
  double radius_;
  Vec3 from_q_;
  double distance_;
};

class BlockFill {
 public:
  BlockFill(const MeshBvh& bvh, const Flattened& surface, FieldGrid& grid)
      : bvh_(bvh), surface_(surface), grid_(grid) {}

  void run(const Place& first) {
    parts_.assign(1, 0);
    fill(first, Place::Constant(8), 0, 0);
  }

 private:
  Vec3 position(const Place& node) const { return grid_.origin + grid_.cell * node.cast<double>(); }

  /// @param begin of the block's list of parts of the hierarchy, up to the end of parts_
  /// @param guess a triangle nearby
  /// @return a better guess for the next block
  int fill(const Place& first, const Place& size, std::size_t begin, int guess) {
    if ((first.array() >= grid_.nodes.array()).any()) return guess;
    const std::size_t end = parts_.size();
    const bool smallest = size.prod() == n_lanes;
    const Vec3 half = 0.5 * grid_.cell * (size - Place::Ones()).cast<double>();
    const Vec3 center = position(first) + half;
    const double radius = half.norm() * (1.0 + 1e-9);
    const Vec3 near =
        size.x() == 8 ? nearest_to(center, guess) : closest_point_on_triangle(bvh_.corners(guess), center);
    const Nearness nearness(center, radius, near);
    keep(nearness, begin, end, size.x() == 8 ? radius : 0.0);
    if (smallest) {
      guess = measure_block(first, end, guess);
    } else {
      int next = guess;
      const Place part = size.x() == 8 ? Place(4, 4, 4) : Place(2, 2, 4);
      for (int z = 0; z < size.z(); z += part.z())
        for (int y = 0; y < size.y(); y += part.y())
          for (int x = 0; x < size.x(); x += part.x()) next = fill(first + Place(x, y, z), part, end, next);
    }
    parts_.resize(end);
    return guess;
  }

  /// The point of the surface nearest to p, of the triangle that `guess` is set to.
  Vec3 nearest_to(const Vec3& p, int& guess) const {
    const Vec3 q = closest_point_on_triangle(bvh_.corners(guess), p);
    const ClosestPoint nearer = bvh_.closest_point(p, (p - q).norm());
    if (nearer.triangle < 0) return q;
    guess = nearer.triangle;
    return nearer.point;
  }

  /// Adds the parts of [begin, end) that may hold the nearest point, opened until none is larger than
  /// `largest`.
  void keep(const Nearness& nearness, std::size_t begin, std::size_t end, double largest) {
    open_.assign(parts_.begin() + static_cast<std::ptrdiff_t>(begin),
                 parts_.begin() + static_cast<std::ptrdiff_t>(end));
    while (!open_.empty()) {
      sift(nearness);
      open_.clear();
      for (const std::int32_t part : kept_) {
        const MeshBvh::Node& node = bvh_.nodes()[static_cast<std::size_t>(part)];
        if (node.count == 0 && node.box.size().squaredNorm() > largest * largest) {
          open_.push_back(node.left);
          open_.push_back(node.left + 1);
        } else {
          parts_.push_back(part);
        }
      }
    }
  }

  /// Those of open_ that may, to kept_.
  void sift(const Nearness& nearness) {
    kept_.resize(open_.size() + n_lanes);
    int n = 0;
    if (nearness.far()) {
      n = functions_.keep(surface_.view(), nearness.in_lanes(surface_.origin), open_.data(),
                          static_cast<int>(open_.size()), kept_.data());
    } else {
      for (const std::int32_t part : open_)
        if (nearness.may_hold(bvh_.nodes()[static_cast<std::size_t>(part)].box))
          kept_[static_cast<std::size_t>(n++)] = part;
    }
    kept_.resize(static_cast<std::size_t>(n));
  }

  /// @return the nearest triangle of a node in the middle
  int measure_block(const Place& first, std::size_t begin, int guess) {
    block_kernel::Nodes nodes{};
    for (int l = 0; l < n_lanes; ++l) {
      const Vec3 p = position(first + node_of_lane(l)) - surface_.origin;
      nodes.x[l] = static_cast<float>(p.x());
      nodes.y[l] = static_cast<float>(p.y());
      nodes.z[l] = static_cast<float>(p.z());
      nodes.triangle[l] = -1;
    }
    const std::size_t n = parts_.size() - begin;
    if (scratch_.size() < n) scratch_.resize(n);
    functions_.measure(surface_.view(), parts_.data() + begin, static_cast<int>(n), nodes,
                       reinterpret_cast<float*>(scratch_.data()));
    for (int l = 0; l < n_lanes; ++l) {
      const int t = nodes.triangle[l] < 0 ? guess : bvh_.triangle_at(nodes.triangle[l]);
      store(first + node_of_lane(l), t, std::sqrt(static_cast<double>(nodes.distance2[l])));
    }
    constexpr int middle = 7;
    return nodes.triangle[middle] < 0 ? guess : bvh_.triangle_at(nodes.triangle[middle]);
  }

  static Place node_of_lane(int lane) { return {lane & 1, lane >> 1 & 1, lane >> 2}; }

  /// @param found distance in single precision
  void store(const Place& node, int triangle, double found) {
    if ((node.array() >= grid_.nodes.array()).any()) return;
    const Vec3 p = position(node);
    double distance = (closest_point_on_triangle(bvh_.corners(triangle), p) - p).norm();
    // Should single precision have been misled by a bad triangle, the whole surface is asked.
    if (std::abs(found - distance) > 1e-5 * distance + 1e-7)
      distance = std::min(distance, bvh_.closest_point(p, distance).distance);
    const auto nx = static_cast<std::size_t>(grid_.nodes.x());
    const auto ny = static_cast<std::size_t>(grid_.nodes.y());
    grid_.values[(static_cast<std::size_t>(node.z()) * ny + static_cast<std::size_t>(node.y())) * nx +
                 static_cast<std::size_t>(node.x())] = static_cast<float>(distance);
  }

  struct alignas(64) Lanes {
    float values[n_lanes];
  };

  const MeshBvh& bvh_;
  const Flattened& surface_;
  FieldGrid& grid_;
  const block_kernel::Functions& functions_ = EIGENGRASP_VARIANT(block_kernel, best_instruction_set());
  std::vector<std::int32_t> parts_;  ///< a stack of lists, one a level
  std::vector<std::int32_t> open_, kept_;
  std::vector<Lanes> scratch_;  ///< one a leaf of the smallest block
};

}  // namespace

void fill_unsigned_distances(const MeshBvh& bvh, FieldGrid& grid, int threads) {
  const Flattened surface(bvh);
  const Place blocks = (grid.nodes.array() + 7) / 8;
  parallel_for(static_cast<std::size_t>(blocks.y() * blocks.z()), threads, [&](std::size_t row, int) {
    BlockFill fill(bvh, surface, grid);
    const auto y = static_cast<int>(row) % blocks.y();
    const auto z = static_cast<int>(row) / blocks.y();
    for (int x = 0; x < blocks.x(); ++x) fill.run(8 * Place(x, y, z));
  });
}

}  // namespace eigengrasp
