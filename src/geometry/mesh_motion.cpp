// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Conservative advancement in the hierarchy: pairs of nodes are divided until each stays apart for as long as
// the nearest triangles that were found so far.
#include "eigengrasp/geometry/mesh_motion.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/moving_boxes.hpp"
#include "geometry/point_speeds.hpp"

namespace eigengrasp {

namespace {

using detail::CenteredBox;
using detail::centered;
using Parts = SeparationFront::Parts;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two surfaces as they are at the time of a look, and their motion.
struct MovingSurfaces {
  const MeshBvh& a;
  const MeshBvh& b;
  const Pose& X_AB;
  const SurfaceMotion& motion;
  const DistanceField* field;  ///< of a, at rest; may be absent
};

class FrontSearch {
 public:
  FrontSearch(const MovingSurfaces& surfaces, double now, double margin, double horizon)
      : a_(surfaces.a),
        b_(surfaces.b),
        X_AB_(surfaces.X_AB),
        speeds_a_(surfaces.motion.of_a, a_.box().center()),
        speeds_b_(surfaces.motion.of_b, X_AB_ * b_.box().center()),
        acceleration_(surfaces.motion.acceleration),
        margin_(margin),
        now_(now),
        horizon_(horizon),
        field_(surfaces.field),
        boxes_(surfaces.motion),
        posed_(a_, b_, X_AB_) {
    best_.time = horizon;
  }

  /// The triangles that limited an earlier time.
  void look_at(const PairHint& triangles) {
    visit(triangles.triangle_a, triangles.triangle_b, posed(triangles.triangle_b), best_.time);
  }

  /// Renews the parts whose time is over before that of the nearest triangles.
  void renew(std::vector<Parts>& front) {
    if (front.empty()) front.push_back({field_ ? -1 : 0, 0, 0.0});
    std::size_t kept = 0;
    const std::size_t n = front.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Parts parts = front[i];
      if (parts.until >= now_ + best_.time)
        front[kept++] = parts;
      else
        divide(parts, front);
    }
    front.erase(front.begin() + static_cast<std::ptrdiff_t>(kept),
                front.begin() + static_cast<std::ptrdiff_t>(n));
  }

  const FreeTime& best() const { return best_; }
  const PairHint& nearest() const { return nearest_; }

 private:
  /// Two nodes and what is known of them.
  struct NodePair {
    int a;  ///< -1: all of a
    int b;
    float gap;    ///< [m] lower bound
    double time;  ///< [s] for which they stay apart
  };

  /// Goes down both hierarchies, the larger node first, then the pair that is free for the shorter time.
  void divide(const Parts& parts, std::vector<Parts>& front) {
    NodePair stack[256];
    int top = 0;
    stack[top++] = looked_at(parts.a, parts.b);
    while (top > 0) {
      const NodePair pair = stack[--top];
      if (pair.time >= best_.time) {
        front.push_back({pair.a, pair.b, now_ + pair.time});
        continue;
      }
      const MeshBvh::Node& nb = b_.nodes()[static_cast<std::size_t>(pair.b)];
      if (pair.a < 0) {
        if (nb.count > 0 || -pair.gap < least_field_part) {
          stack[top++] = looked_at(0, pair.b);
        } else {
          push_nearer_last(looked_at(-1, nb.left), looked_at(-1, nb.left + 1), stack, top);
        }
        continue;
      }
      const MeshBvh::Node& na = a_.nodes()[static_cast<std::size_t>(pair.a)];
      if (na.count > 0 && nb.count > 0) {
        front.push_back({pair.a, pair.b, now_ + visit_leaves(na, nb)});
      } else if (nb.count > 0 || (na.count == 0 && largest_half(a_, pair.a) >= largest_half(b_, pair.b))) {
        push_nearer_last(looked_at(na.left, pair.b), looked_at(na.left + 1, pair.b), stack, top);
      } else {
        push_nearer_last(looked_at(pair.a, nb.left), looked_at(pair.a, nb.left + 1), stack, top);
      }
    }
  }

  static float largest_half(const MeshBvh& bvh, int node) {
    return detail::largest(detail::load(bvh.oriented_box(node).half));
  }

  static void push_nearer_last(const NodePair& p, const NodePair& q, NodePair* stack, int& top) {
    const bool p_is_nearer = p.time < q.time || (p.time == q.time && p.gap < q.gap);
    stack[top++] = p_is_nearer ? q : p;
    stack[top++] = p_is_nearer ? p : q;
  }

  NodePair looked_at(int a, int b) const {
    if (a < 0) return looked_at_in_field(b);
    const auto outlook =
        boxes_.look(detail::turned(a_.oriented_box(a)), posed_.box(b), margin_, acceleration_);
    return {a, b, outlook.gap, outlook.time};
  }

  NodePair looked_at_in_field(int b) const {
    const auto [at, radius] = posed_.ball(b);
    const Vec3 center(at[0], at[1], at[2]);
    const double gap = certain_distance(*field_, center) - radius - margin_;
    return {-1, b, -radius, time_to_close(gap, speeds_b_.within(center, radius), acceleration_)};
  }

  TriangleCorners posed(int t) const {
    const TriangleCorners& c = b_.corners(t);
    return {X_AB_ * c.a, X_AB_ * c.b, X_AB_ * c.c};
  }

  /// How far what is in two boxes may come together along each axis until a time: from `low` to `high`.
  struct Sweep {
    Vec3 low;
    Vec3 high;
  };
  Sweep sweep_of(const CenteredBox& a, const CenteredBox& b, double time) const {
    const double reserve = margin_ + 0.5 * acceleration_ * time * time;
    Sweep sweep{Vec3::Constant(-reserve), Vec3::Constant(reserve)};
    speeds_b_.sweep(b, time, sweep.low, sweep.high);
    speeds_a_.sweep(a, -time, sweep.high, sweep.low);
    return sweep;
  }

  static bool stay_apart(const Box& a, const Box& b, const Sweep& sweep) {
    return ((a.min.array() > (b.max + sweep.high).array()) || ((b.min + sweep.low).array() > a.max.array()))
        .any();
  }

  static Box box_about(const TriangleCorners& t) {
    return {t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c)};
  }

  /// Time for which the triangles of two leaves stay apart, or some multiple of the best if they stay longer.
  double visit_leaves(const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    constexpr int most = 8;  // triangles of a leaf
    TriangleCorners ts[most];
    Box boxes[most];
    Box all;
    for (int j = 0; j < nb.count; ++j) {
      ts[j] = posed(b_.triangle_at(nb.left + j));
      boxes[j] = box_about(ts[j]);
      all.add(boxes[j]);
    }
    const double enough = std::max(best_.time, std::min(horizon_, leaf_foresight * best_.time));
    const Sweep sweep = sweep_of(centered(na.box), centered(all), enough);
    double least = enough;
    for (int i = na.left; i < na.left + na.count; ++i) {
      const int ta = a_.triangle_at(i);
      const Box box_a = box_about(a_.corners(ta));
      if (stay_apart(box_a, all, sweep)) continue;
      for (int j = 0; j < nb.count; ++j)
        if (!stay_apart(box_a, boxes[j], sweep))
          least = std::min(least, visit(ta, b_.triangle_at(nb.left + j), ts[j], enough));
    }
    return least;
  }

  /// Time for which two triangles stay apart, sharp where it is less than the best so far, and at most about
  /// `enough`.
  double visit(int ta, int tb, const TriangleCorners& t, double enough) {
    const TriangleCorners& s = a_.corners(ta);
    double time = time_of_plane(s, t, 1.0, enough);
    if (time < enough) time = std::max(time, time_of_plane(t, s, -1.0, enough));
    if (time >= best_.time) return time;
    time = std::max(time, time_along(s, t));
    if (time >= best_.time) return time;
    Vec3 p;
    Vec3 q;
    const double d = closest_points_of_triangles(s, t, p, q);
    if (d > 0.0) {
      const double rate = closing_rate(s, t, (q - p) / d);
      time = std::max(time, time_to_close(d - std::min(margin_, 0.5 * d), rate, acceleration_));
    }
    if (time < best_.time) {
      best_ = {time, d};
      nearest_ = {ta, tb};
      if (d > 0.0) direction_ = (q - p) / d;
    }
    return time;
  }

  /// Time for which two triangles stay apart as the direction tells in which the nearest ones face each other.
  double time_along(const TriangleCorners& s, const TriangleCorners& t) const {
    const Vec3& n = direction_;
    const double gap = std::min({n.dot(t.a), n.dot(t.b), n.dot(t.c)}) -
                       std::max({n.dot(s.a), n.dot(s.b), n.dot(s.c)}) - margin_;
    return gap > 0.0 ? time_to_close(gap, closing_rate(s, t, n), acceleration_) : 0.0;
  }

  /// Time for which the plane of triangle s keeps t away; infinite as soon as that is enough. side: 1 where s
  /// is of a, -1 where it is of b.
  double time_of_plane(const TriangleCorners& s, const TriangleCorners& t, double side, double enough) const {
    Vec3 n = (s.b - s.a).cross(s.c - s.a);
    const double da = n.dot(t.a - s.a);
    const double db = n.dot(t.b - s.a);
    const double dc = n.dot(t.c - s.a);
    const bool above = da > 0.0;
    const double nearest = above ? std::min({da, db, dc}) : -std::max({da, db, dc});
    const double length2 = n.squaredNorm();
    if (!(nearest > 0.0) || !(length2 > 1e-16 * (s.b - s.a).squaredNorm() * (s.c - s.a).squaredNorm()))
      return 0.0;
    const double length = std::sqrt(length2);
    const double gap = nearest / length - margin_;
    if (gap <= 0.0) return 0.0;
    n *= (above ? side : -side) / length;
    const double rate = closing_rate(side > 0.0 ? s : t, side > 0.0 ? t : s, n);
    if (enough * (rate + 0.5 * acceleration_ * enough) < gap) return infinity;
    return time_to_close(gap, rate, acceleration_);
  }

  /// How fast two triangles can close their gap along the direction n from a to b.
  double closing_rate(const TriangleCorners& s, const TriangleCorners& t, const Vec3& n) const {
    return speeds_a_.along(s, n) + speeds_b_.along(t, -n);
  }

  static constexpr float least_field_part = 0.004f;  // [m] smaller ones are left to boxes
  static constexpr double leaf_foresight = 3.0;      // leaves that are looked at are done for so many times

  const MeshBvh& a_;
  const MeshBvh& b_;
  const Pose& X_AB_;
  detail::PointSpeeds speeds_a_;
  detail::PointSpeeds speeds_b_;
  double acceleration_;
  double margin_;
  double now_;
  double horizon_;
  const DistanceField* field_;
  detail::MovingBoxes boxes_;
  detail::PosedBoxes posed_;
  FreeTime best_;
  PairHint nearest_;
  Vec3 direction_ = Vec3::Zero();  ///< from a to b, of the nearest triangles
};

}  // namespace

double time_to_close(double gap, double rate, double acceleration) {
  if (gap <= 0.0) return 0.0;
  const double root = std::sqrt(rate * rate + 2.0 * acceleration * gap);
  // gap = rate t + acceleration t^2 / 2; of the two forms of its solution the one without cancellation.
  if (rate >= 0.0) return root > 0.0 ? 2.0 * gap / (rate + root) : infinity;
  return acceleration > 0.0 ? (root - rate) / acceleration : infinity;
}

FreeTime SeparationFront::look(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB,
                               const SurfaceMotion& motion, double now, double margin, double horizon,
                               const DistanceField& field, double touching) {
  if (a.empty() || b.empty()) {
    free_until_ = infinity;
    return {horizon, infinity};
  }
  FrontSearch search({a, b, X_AB, motion, field.empty() ? nullptr : &field}, now, margin, horizon);
  if (nearest_.triangle_a >= 0) search.look_at(nearest_);
  if (search.best().distance <= touching) return search.best();
  search.renew(parts_);
  if (search.nearest().triangle_a >= 0) nearest_ = search.nearest();
  free_until_ = infinity;
  for (const Parts& parts : parts_) free_until_ = std::min(free_until_, parts.until);
  return search.best();
}

FreeTime compute_free_time(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                           double margin, double horizon, PairHint* hint, const DistanceField& field) {
  SeparationFront front(hint ? *hint : PairHint{});
  const FreeTime free = front.look(a, b, X_AB, motion, 0.0, margin, horizon, field);
  if (hint) *hint = front.nearest();
  return free;
}

}  // namespace eigengrasp
