// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Conservative advancement in the hierarchy: boxes are grown by what they may move in the time that is known
// to be free so far, and only what they then meet is looked at.
#include "eigengrasp/geometry/mesh_motion.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/oriented_boxes.hpp"

namespace eigengrasp {

namespace {

struct CenteredBox {
  Vec3 center;
  Vec3 half;
};

class FreeTimeSearch {
 public:
  FreeTimeSearch(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                 double margin, double horizon, const DistanceField& field)
      : a_(a),
        b_(b),
        X_AB_(X_AB),
        motion_(motion),
        margin_(margin),
        field_(field.empty() ? nullptr : &field) {
    best_.time = horizon;
    middle_ = X_AB * b.box().center();
    for (const Screw& s : motion.joints) {
      const Vec3 v = s.velocity(middle_);
      forward_ += v.cwiseMax(Vec3::Zero());
      backward_ += v.cwiseMin(Vec3::Zero());
      turning_ += s.angular.cwiseAbs();
      speed_ += v.norm();
      spin_ += s.angular.norm();
    }
  }

  FreeTime run(PairHint* hint) {
    if (hint && hint->triangle_a >= 0) visit(hint->triangle_a, hint->triangle_b, posed(hint->triangle_b));
    detail::descend(
        a_, b_, X_AB_,
        [this](double gap, const MeshBvh::Node& na, const detail::TurnedBox& box) {
          return matters(gap, na, box);
        },
        [this](const MeshBvh::Node& na, const MeshBvh::Node& nb) { return visit_leaves(na, nb); });
    if (hint && nearest_.triangle_a >= 0) *hint = nearest_;
    return best_;
  }

 private:
  TriangleCorners posed(int t) const {
    const TriangleCorners& c = b_.corners(t);
    return {X_AB_ * c.a, X_AB_ * c.b, X_AB_ * c.c};
  }

  /// Where the box may get until the best time, with the margin about it.
  Box swept(const CenteredBox& box) const {
    const double t = best_.time;
    const Vec3 arm = (box.center - middle_).cwiseAbs() + box.half;
    const Vec3 turned(turning_.y() * arm.z() + turning_.z() * arm.y(),
                      turning_.z() * arm.x() + turning_.x() * arm.z(),
                      turning_.x() * arm.y() + turning_.y() * arm.x());
    const Vec3 reach = box.half + t * turned + Vec3::Constant(0.5 * motion_.acceleration * t * t + margin_);
    return {box.center - reach + t * backward_, box.center + reach + t * forward_};
  }

  static bool apart(const Box& a, const Box& b) {
    return a.min.x() > b.max.x() || b.min.x() > a.max.x() || a.min.y() > b.max.y() || b.min.y() > a.max.y() ||
           a.min.z() > b.max.z() || b.min.z() > a.max.z();
  }

  /// Largest speed against the direction n that any corner can have.
  double closing_rate(const TriangleCorners& t, const Vec3& n) const {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    for (const Screw& s : motion_.joints) {
      const double still = -n.dot(s.linear);
      const Vec3 m = s.angular.cross(n);  // n . (w x p) = -(w x n) . p
      a += std::max(0.0, still + m.dot(t.a));
      b += std::max(0.0, still + m.dot(t.b));
      c += std::max(0.0, still + m.dot(t.c));
    }
    return std::max({a, b, c});
  }

  /// Whether the plane of triangle s keeps t away for longer than the best time. sign: -1 where t is the one
  /// that stands still.
  bool plane_keeps(const TriangleCorners& s, const TriangleCorners& t, const TriangleCorners& moving,
                   double sign) const {
    Vec3 n = (s.b - s.a).cross(s.c - s.a);
    const double da = n.dot(t.a - s.a);
    const double db = n.dot(t.b - s.a);
    const double dc = n.dot(t.c - s.a);
    const bool above = da > 0.0;
    const double nearest = above ? std::min({da, db, dc}) : -std::max({da, db, dc});
    const double length2 = n.squaredNorm();
    if (!(nearest > 0.0) || !(length2 > 1e-16 * (s.b - s.a).squaredNorm() * (s.c - s.a).squaredNorm()))
      return false;
    const double length = std::sqrt(length2);
    const double t_best = best_.time;
    const double left = nearest / length - margin_ - 0.5 * motion_.acceleration * t_best * t_best;
    if (left <= 0.0) return false;
    n *= (above ? sign : -sign) / length;
    return closing_rate(moving, n) * t_best < left;
  }

  /// True where the search is over: the surfaces cross.
  bool visit(int ta, int tb, const TriangleCorners& t) {
    const TriangleCorners& s = a_.corners(ta);
    if (plane_keeps(s, t, t, 1.0) || plane_keeps(t, s, t, -1.0)) return false;
    Vec3 p;
    Vec3 q;
    const double d = closest_points_of_triangles(s, t, p, q);
    double time = 0.0;
    if (d > 0.0) {
      const Vec3 n = (q - p) / d;
      time = time_to_close(d - std::min(margin_, 0.5 * d), closing_rate(t, n), motion_.acceleration);
    }
    if (time < best_.time) {
      best_ = {time, d};
      nearest_ = {ta, tb};
    }
    return d == 0.0;
  }

  /// Whether what is in the box of b, with a gap to the node of a, may come within the margin of it before
  /// the best time: not if no motion is fast enough for the gap, not if none goes that way, and not if the
  /// field knows better.
  bool matters(double gap, const MeshBvh::Node& na, const detail::TurnedBox& box) const {
    const double t = best_.time;
    const Vec3 center(box.center[0], box.center[1], box.center[2]);
    const double radius =
        std::sqrt(box.half[0] * box.half[0] + box.half[1] * box.half[1] + box.half[2] * box.half[2]);
    const double speed = speed_ + spin_ * ((center - middle_).norm() + radius);
    const double reach = margin_ + t * (speed + 0.5 * motion_.acceleration * t);
    if (gap > reach) return false;
    Vec3 half;
    for (int k = 0; k < 3; ++k) {
      const detail::Float4 extents = box.half * detail::magnitude(box.rows[k]);
      half[k] = 1.000001 * (extents[0] + extents[1] + extents[2]);
    }
    if (apart(na.box, swept({center, half}))) return false;
    return !field_ || certain_distance(*field_, center) <= 1.000001 * radius + reach;
  }

  bool visit_leaves(const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    for (int j = nb.left; j < nb.left + nb.count; ++j) {
      const int tb = b_.triangle_at(j);
      const TriangleCorners t = posed(tb);
      const Vec3 low = t.a.cwiseMin(t.b).cwiseMin(t.c);
      const Vec3 high = t.a.cwiseMax(t.b).cwiseMax(t.c);
      const CenteredBox box{0.5 * (low + high), 0.5 * (high - low)};
      Box sweep = swept(box);
      if (apart(na.box, sweep)) continue;
      for (int i = na.left; i < na.left + na.count; ++i) {
        const int ta = a_.triangle_at(i);
        const TriangleCorners& s = a_.corners(ta);
        const Box of_s{s.a.cwiseMin(s.b).cwiseMin(s.c), s.a.cwiseMax(s.b).cwiseMax(s.c)};
        if (apart(of_s, sweep)) continue;
        if (visit(ta, tb, t)) return true;
        sweep = swept(box);
      }
    }
    return false;
  }

  const MeshBvh& a_;
  const MeshBvh& b_;
  const Pose& X_AB_;
  SurfaceMotion motion_;
  double margin_;
  const DistanceField* field_;  ///< of a; may be absent
  Vec3 middle_;
  Vec3 forward_ = Vec3::Zero();   ///< of the middle: what joints that move it along each axis add up to
  Vec3 backward_ = Vec3::Zero();  ///< and those that move it against it
  Vec3 turning_ = Vec3::Zero();   ///< sums of the joints' angular speeds about each axis
  double speed_ = 0.0;            ///< of the middle
  double spin_ = 0.0;
  FreeTime best_;
  PairHint nearest_;
};

}  // namespace

double certain_distance(const DistanceField& field, const Vec3& p) {
  constexpr double half_diagonal = 0.8661;  // of a cell
  const FieldGrid* grid = &field.fine();
  if (!grid->contains(p)) grid = &field.coarse();
  if (!grid->contains(p)) {
    const Box box = grid->box();
    return (box.min - p).cwiseMax(p - box.max).cwiseMax(Vec3::Zero()).norm();
  }
  return std::abs(grid->value(p)) - half_diagonal * grid->cell;
}

double time_to_close(double gap, double rate, double acceleration) {
  if (gap <= 0.0) return 0.0;
  const double root = std::sqrt(rate * rate + 2.0 * acceleration * gap);
  // gap = rate t + acceleration t^2 / 2; of the two forms of its solution the one without cancellation.
  if (rate >= 0.0) return root > 0.0 ? 2.0 * gap / (rate + root) : std::numeric_limits<double>::infinity();
  return acceleration > 0.0 ? (root - rate) / acceleration : std::numeric_limits<double>::infinity();
}

FreeTime compute_free_time(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                           double margin, double horizon, PairHint* hint, const DistanceField& field) {
  if (a.empty() || b.empty()) return {horizon, std::numeric_limits<double>::infinity()};
  return FreeTimeSearch(a, b, X_AB, motion, margin, horizon, field).run(hint);
}

}  // namespace eigengrasp
