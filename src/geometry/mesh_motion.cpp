// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Conservative advancement in the hierarchy: pairs of nodes are divided until each stays apart for as long as
// the nearest triangles that were found so far.
#include "eigengrasp/geometry/mesh_motion.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/box_descent.hpp"
#include "geometry/point_speeds.hpp"

namespace eigengrasp {

namespace {

using detail::centered;
using detail::CenteredBox;
using detail::NodePair;
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
  /// @param borrow_directions triangles may be kept apart along the direction in which others face each
  /// other: cheap, but then the time depends on the order in which they are seen
  FrontSearch(const MovingSurfaces& surfaces, double now, double margin, double horizon,
              bool borrow_directions)
      : a_(surfaces.a),
        b_(surfaces.b),
        X_AB_(surfaces.X_AB),
        speeds_a_(surfaces.motion.of_a, a_.box().center()),
        speeds_b_(surfaces.motion.of_b, X_AB_ * b_.box().center()),
        acceleration_(surfaces.motion.acceleration),
        margin_(margin),
        now_(now),
        horizon_(horizon),
        borrow_directions_(borrow_directions),
        field_(surfaces.field),
        boxes_(a_, b_, X_AB_) {
    best_.time = horizon;
    clearance_ = margin;
    boxes_.set_motion(surfaces.motion, margin);
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
    int waiting = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Parts parts = front[i];
      if (parts.until >= now_ + best_.time) {
        if (kept != i) front[kept] = parts;
        ++kept;
        continue;
      }
      stack_.push({parts.a, parts.b, 0.0});
      if (++waiting < detail::BoxPairs::most) continue;
      divide(front);
      waiting = 0;
    }
    divide(front);
    front.erase(front.begin() + static_cast<std::ptrdiff_t>(kept),
                front.begin() + static_cast<std::ptrdiff_t>(n));
  }

  const FreeTime& best() const { return best_; }
  /// Distance that all triangles are sure to keep for their times.
  double clearance() const { return clearance_; }
  const PairHint& nearest() const { return nearest_; }

 private:
  /// Goes down both hierarchies from the pairs on the stack, the larger node first, and first with the pairs
  /// that are free for the shortest time.
  void divide(std::vector<Parts>& front) {
    while (!stack_.empty()) {
      take(front);
      if (boxes_.size() == 0) continue;
      boxes_.look_at_times(best_.time);
      inner_.clear();
      for (int i = 0; i < boxes_.size(); ++i) {
        const NodePair pair{taken_[i].a, taken_[i].b, std::max(taken_[i].bound, boxes_.time(i))};
        const MeshBvh::Node& na = a_.nodes()[static_cast<std::size_t>(pair.a)];
        const MeshBvh::Node& nb = b_.nodes()[static_cast<std::size_t>(pair.b)];
        if (pair.bound >= best_.time) {
          front.push_back({pair.a, pair.b, now_ + pair.bound});
        } else if (na.count > 0 && nb.count > 0) {
          front.push_back({pair.a, pair.b, now_ + visit_leaves(na, nb)});
        } else {
          inner_.add(pair);
        }
      }
      for (const NodePair& pair : inner_) detail::push_children(a_, b_, pair, stack_);
    }
  }

  /// Takes pairs from the stack whose boxes are to be looked at; those of which the field or their parents
  /// tell enough go to the front.
  void take(std::vector<Parts>& front) {
    boxes_.clear();
    for (int most = stack_.batch(); boxes_.size() < most && !stack_.empty();) {
      NodePair pair = stack_.pop();
      if (pair.a < 0 && pair.bound < best_.time) pair.bound = std::max(pair.bound, time_in_field(pair.b));
      if (pair.bound >= best_.time) {
        front.push_back({pair.a, pair.b, now_ + pair.bound});
      } else if (pair.a < 0) {
        divide_in_field(pair);
      } else {
        taken_[boxes_.size()] = pair;
        boxes_.add(pair.a, pair.b);
      }
    }
  }

  void divide_in_field(const NodePair& pair) {
    const MeshBvh::Node& n = b_.nodes()[static_cast<std::size_t>(pair.b)];
    if (n.count > 0 || boxes_.ball(pair.b).radius < least_field_part) {
      stack_.push({0, pair.b, pair.bound});
    } else {
      stack_.push({-1, n.left + 1, pair.bound});
      stack_.push({-1, n.left, pair.bound});
    }
  }

  double time_in_field(int b) const {
    const auto [center, radius] = boxes_.ball(b);
    const double gap = certain_distance(*field_, center) - radius - margin_;
    return time_to_close(gap, speeds_b_.within(center, radius), acceleration_);
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
    if (borrow_directions_) time = std::max(time, time_along(s, t));
    if (time >= best_.time) return time;
    Vec3 p;
    Vec3 q;
    const double d = closest_points_of_triangles(s, t, p, q);
    const double kept = std::min(margin_, 0.5 * d);
    clearance_ = std::min(clearance_, kept);
    if (d > 0.0) {
      const double rate = closing_rate(s, t, (q - p) / d);
      time = std::max(time, time_to_close(d - kept, rate, acceleration_));
    }
    if (time < best_.time) {
      best_ = {time, d};
      nearest_ = {ta, tb};
      if (d > 0.0) direction_ = (q - p) / d;
    }
    return time;
  }

  /// Time for which two triangles stay apart as the direction tells in which the nearest ones face each
  /// other.
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

  static constexpr double least_field_part = 0.004;  // [m] smaller ones are left to boxes
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
  bool borrow_directions_;
  const DistanceField* field_;
  detail::BoxPairs boxes_;
  detail::NodeStack stack_;
  NodePair taken_[detail::BoxPairs::most];  ///< those whose boxes are looked at
  detail::SortedPairs inner_;
  FreeTime best_;
  double clearance_;
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
    clearance_ = infinity;
    return {horizon, infinity};
  }
  FrontSearch search({a, b, X_AB, motion, field.empty() ? nullptr : &field}, now, margin, horizon, true);
  if (nearest_.triangle_a >= 0) search.look_at(nearest_);
  if (search.best().distance <= touching) return search.best();
  if (parts_.empty()) clearance_ = margin;
  search.renew(parts_);
  clearance_ = std::min(clearance_, search.clearance());
  if (search.nearest().triangle_a >= 0) nearest_ = search.nearest();
  free_until_ = infinity;
  for (const Parts& parts : parts_) free_until_ = std::min(free_until_, parts.until);
  return search.best();
}

FreeTime compute_free_time(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                           double margin, double horizon, PairHint* hint) {
  if (a.empty() || b.empty()) return {horizon, infinity};
  FrontSearch search({a, b, X_AB, motion, nullptr}, 0.0, margin, horizon, false);
  if (hint && hint->triangle_a >= 0) search.look_at(*hint);
  std::vector<Parts> front;
  search.renew(front);
  if (hint && search.nearest().triangle_a >= 0) *hint = search.nearest();
  return search.best();
}

}  // namespace eigengrasp
