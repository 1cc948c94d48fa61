// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/ball_cover.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/variants.hpp"
#include "geometry/kernel/ball_looks.hpp"
#include "geometry/triangle_pieces.hpp"

namespace eigengrasp {

namespace {

using ball_kernel::BallPack;
using kernel::n_lanes;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t most_joints = 32;

/// More than single precision may be off in the space that a field covers [m].
double rounding_in(const DistanceField& field) {
  return std::max(3e-6, 1e-6 * field.scale() * field.coarse().box().diagonal());
}

/// Makes spheres larger until they hold a surface: what none holds is halved until the nearest can hold it.
class Growth {
 public:
  Growth(const std::vector<Sphere>& spheres, const std::vector<SphereGroup>& groups)
      : spheres_(spheres), groups_(groups), grown_(spheres) {}

  void hold(const TriangleCorners& t) {
    if (is_held(t)) return;
    const Vec3 center = detail::center_of(t);
    const double size = detail::size_about(t, center);
    near_ = groups_;
    const double excess = find_nearest(center).excess;
    std::erase_if(near_, [&](const SphereGroup& g) { return least_excess(g, center) > excess + 2.0 * size; });
    hold_piece(t);
  }

  std::vector<Sphere> grown() { return std::move(grown_); }

 private:
  void hold_piece(const TriangleCorners& t) {
    constexpr double side = 0.001;  // [m]
    if (is_held(t)) return;
    const Vec3 center = detail::center_of(t);
    last_ = find_nearest(center).sphere;
    if (is_held(t)) return;
    const TriangleCorners s = detail::longest_side_first(t);
    if ((s.b - s.a).squaredNorm() <= side * side) {
      const Vec3& c = spheres_[last_].center;
      grown_[last_].radius = std::max({(t.a - c).norm(), (t.b - c).norm(), (t.c - c).norm()});
      return;
    }
    const Vec3 middle = 0.5 * (s.a + s.b);
    hold_piece({s.b, s.c, middle});
    hold_piece({s.c, s.a, middle});
  }

  /// By the sphere that was nearest to what was looked at last.
  bool is_held(const TriangleCorners& t) const {
    const Vec3& c = spheres_[last_].center;
    const double radius2 = grown_[last_].radius * grown_[last_].radius;
    return (t.a - c).squaredNorm() <= radius2 && (t.b - c).squaredNorm() <= radius2 &&
           (t.c - c).squaredNorm() <= radius2;
  }

  /// The sphere out of which a point sticks least, and how far.
  struct Nearest {
    std::size_t sphere;
    double excess;
  };

  Nearest find_nearest(const Vec3& p) const {
    Nearest nearest{last_, excess_of(last_, p)};
    for (const SphereGroup& g : near_) {
      if (least_excess(g, p) >= nearest.excess) continue;
      for (auto i = static_cast<std::size_t>(g.first); i < static_cast<std::size_t>(g.first + g.count); ++i)
        if (const double excess = excess_of(i, p); excess < nearest.excess) nearest = {i, excess};
    }
    return nearest;
  }
  double excess_of(std::size_t i, const Vec3& p) const {
    return (p - spheres_[i].center).norm() - spheres_[i].radius;
  }
  static double least_excess(const SphereGroup& g, const Vec3& p) {
    return (p - g.bound.center).norm() - g.bound.radius;
  }

  const std::vector<Sphere>& spheres_;
  const std::vector<SphereGroup>& groups_;
  std::vector<SphereGroup> near_;  ///< to the triangle
  std::vector<Sphere> grown_;
  std::size_t last_ = 0;
};

}  // namespace

std::vector<Sphere> grow_to_hold(const MeshBvh& surface, std::vector<Sphere> spheres) {
  if (spheres.empty()) return spheres;
  const std::vector<SphereGroup> groups = group_spheres(spheres, n_lanes);
  Growth growth(spheres, groups);
  for (int t = 0; t < surface.triangle_count(); ++t) growth.hold(surface.corners(t));
  return growth.grown();
}

namespace {

void put(BallPack& pack, std::size_t lane, const Sphere& s) {
  pack.x[lane] = static_cast<float>(s.center.x());
  pack.y[lane] = static_cast<float>(s.center.y());
  pack.z[lane] = static_cast<float>(s.center.z());
  pack.radius[lane] = static_cast<float>(s.radius);
}

BallPack pack_of_none() {
  constexpr float never = -1e9f;  // radius of a ball that is far from everything
  BallPack pack{};
  std::fill(std::begin(pack.radius), std::end(pack.radius), never);
  return pack;
}

ball_kernel::GridView view(const FieldGrid& grid, double scale) {
  ball_kernel::GridView v{};
  v.values = reinterpret_cast<const std::int32_t*>(grid.values.data());
  for (int k = 0; k < 3; ++k) {
    v.origin[k] = static_cast<float>(scale * grid.origin[k]);
    v.last[k] = static_cast<float>(grid.nodes[k] - 1);
  }
  v.cell = static_cast<float>(scale * grid.cell);
  v.inverse_cell = static_cast<float>(1.0 / (scale * grid.cell));
  v.row = grid.nodes.x();
  v.layer = grid.nodes.x() * grid.nodes.y();
  return v;
}

}  // namespace

struct BallCover::Packs {
  std::vector<BallPack> balls;
  std::vector<BallPack> clusters;  ///< a ball about each pack of balls
};

BallCover::BallCover(std::vector<Sphere> spheres) {
  if (spheres.empty()) return;
  const std::vector<SphereGroup> groups = group_spheres(spheres, n_lanes);
  Packs packs;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    packs.balls.push_back(pack_of_none());
    for (int k = 0; k < groups[i].count; ++k)
      put(packs.balls.back(), static_cast<std::size_t>(k),
          spheres[static_cast<std::size_t>(groups[i].first + k)]);
    if (i % n_lanes == 0) packs.clusters.push_back(pack_of_none());
    put(packs.clusters.back(), i % n_lanes, groups[i].bound);
  }
  packs_ = std::make_shared<const Packs>(std::move(packs));
}

double BallCover::free_time(const DistanceField& field, const Pose& X_FB, const SurfaceMotion& motion,
                            double margin, double enough, double too_little) const {
  if (empty() || field.empty() || motion.of_b.size() > most_joints) return 0.0;
  ball_kernel::Motion m{};
  m.fine = view(field.fine(), field.scale());
  m.coarse = view(field.coarse(), field.scale());
  m.scale = static_cast<float>(field.scale());
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m.rotation[r][c] = static_cast<float>(X_FB.linear()(r, c));
    m.origin[r] = static_cast<float>(X_FB.translation()[r]);
  }
  std::array<ball_kernel::Joint, most_joints> joints;
  for (std::size_t j = 0; j < motion.of_b.size(); ++j)
    for (int k = 0; k < 3; ++k) {
      joints[j].angular[k] = static_cast<float>(motion.of_b[j].angular[k]);
      joints[j].linear[k] = static_cast<float>(motion.of_b[j].linear[k]);
    }
  m.joints = joints.data();
  m.n = static_cast<int>(motion.of_b.size());
  m.margin = static_cast<float>(margin + rounding_in(field));
  m.acceleration = static_cast<float>(1.000001 * motion.acceleration);

  static const ball_kernel::Functions& functions = EIGENGRASP_VARIANT(ball_kernel, best_instruction_set());
  alignas(64) float of_clusters[n_lanes];
  alignas(64) float of_balls[n_lanes];
  double least = infinity;
  for (std::size_t c = 0; c < packs_->clusters.size(); ++c) {
    functions.times(m, packs_->clusters[c], of_clusters);
    const std::size_t first = c * n_lanes;
    const std::size_t n = std::min<std::size_t>(n_lanes, packs_->balls.size() - first);
    for (std::size_t i = 0; i < n; ++i) {
      double time = of_clusters[i];
      if (time < std::min(enough, least)) {
        functions.times(m, packs_->balls[first + i], of_balls);
        time = *std::min_element(of_balls, of_balls + n_lanes);
      }
      least = std::min(least, time);
      if (least < too_little) return least;
    }
  }
  return least;
}

}  // namespace eigengrasp
