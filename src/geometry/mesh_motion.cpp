// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Conservative advancement in the hierarchy: boxes are grown by what they may move in the time that is known
// to be free so far, and only what they then meet is looked at.
#include "eigengrasp/geometry/mesh_motion.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/moving_boxes.hpp"

namespace eigengrasp {

namespace {

struct CenteredBox {
  Vec3 center;
  Vec3 half;
};

CenteredBox centered(const Box& box) {
  return {box.center(), 0.5 * box.size()};
}

/// What the joints of one surface may do to its points, to first order.
class PointSpeeds {
 public:
  PointSpeeds(std::span<const Screw> joints, const Vec3& middle) : joints_(joints), middle_(middle) {
    for (const Screw& s : joints) {
      const Vec3 v = s.velocity(middle_);
      forward_ += v.cwiseMax(Vec3::Zero());
      backward_ += v.cwiseMin(Vec3::Zero());
      turning_ += s.angular.cwiseAbs();
      speed_ += v.norm();
      spin_ += s.angular.norm();
    }
  }

  bool still() const { return joints_.empty(); }

  /// Largest speed in a ball.
  double within(const Vec3& center, double radius) const {
    return still() ? 0.0 : speed_ + spin_ * ((center - middle_).norm() + radius);
  }

  /// Adds t times the ranges of velocity in a box, along each axis.
  void sweep(const CenteredBox& box, double t, Vec3& low, Vec3& high) const {
    if (still()) return;
    const Vec3 arm = (box.center - middle_).cwiseAbs() + box.half;
    const Vec3 turned(turning_.y() * arm.z() + turning_.z() * arm.y(),
                      turning_.z() * arm.x() + turning_.x() * arm.z(),
                      turning_.x() * arm.y() + turning_.y() * arm.x());
    low += t * (backward_ - turned);
    high += t * (forward_ + turned);
  }

  /// Largest speed of any corner along the direction n.
  double along(const TriangleCorners& t, const Vec3& n) const {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    for (const Screw& s : joints_) {
      const double still = n.dot(s.linear);
      const Vec3 m = n.cross(s.angular);  // n . (w x p) = (n x w) . p
      a += std::max(0.0, still + m.dot(t.a));
      b += std::max(0.0, still + m.dot(t.b));
      c += std::max(0.0, still + m.dot(t.c));
    }
    return std::max({a, b, c});
  }

 private:
  std::span<const Screw> joints_;
  Vec3 middle_;
  Vec3 forward_ = Vec3::Zero();   ///< velocity of the middle: of the joints that move it along each axis
  Vec3 backward_ = Vec3::Zero();  ///< and of those that move it against it
  Vec3 turning_ = Vec3::Zero();   ///< sums of the joints' angular speeds about each axis
  double speed_ = 0.0;            ///< of the middle
  double spin_ = 0.0;
};

class FreeTimeSearch {
 public:
  FreeTimeSearch(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                 double margin, double horizon, const DistanceField& field)
      : a_(a),
        b_(b),
        X_AB_(X_AB),
        speeds_a_(motion.of_a, a.box().center()),
        speeds_b_(motion.of_b, X_AB * b.box().center()),
        acceleration_(motion.acceleration),
        margin_(margin),
        field_(field.empty() ? nullptr : &field),
        boxes_(motion),
        posed_(a, b, X_AB) {
    best_.time = horizon;
    if (field_) clearances_.resize(b.nodes().size());
  }

  FreeTime run(PairHint* hint, double touching) {
    if (hint && hint->triangle_a >= 0) visit(hint->triangle_a, hint->triangle_b, posed(hint->triangle_b));
    if (best_.distance <= touching) return best_;
    descend();
    if (hint && nearest_.triangle_a >= 0) *hint = nearest_;
    return best_;
  }

 private:
  TriangleCorners posed(int t) const {
    const TriangleCorners& c = b_.corners(t);
    return {X_AB_ * c.a, X_AB_ * c.b, X_AB_ * c.c};
  }

  double reserve() const { return margin_ + 0.5 * acceleration_ * best_.time * best_.time; }

  /// How far what is in two boxes may come together along each axis until the best time: from `low` to
  /// `high`.
  struct Sweep {
    Vec3 low;
    Vec3 high;
  };
  Sweep sweep_of(const CenteredBox& a, const CenteredBox& b) const {
    Sweep sweep{Vec3::Constant(-reserve()), Vec3::Constant(reserve())};
    speeds_b_.sweep(b, best_.time, sweep.low, sweep.high);
    speeds_a_.sweep(a, -best_.time, sweep.high, sweep.low);
    return sweep;
  }

  static bool stay_apart(const Box& a, const Box& b, const Sweep& sweep) {
    return ((a.min.array() > (b.max + sweep.high).array()) || ((b.min + sweep.low).array() > a.max.array()))
        .any();
  }

  /// Time for which the plane of triangle s keeps t away; infinite as soon as that is longer than the best.
  /// side: 1 where s is of a, -1 where it is of b.
  double time_of_plane(const TriangleCorners& s, const TriangleCorners& t, double side) const {
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
    if (best_.time * (rate + 0.5 * acceleration_ * best_.time) < gap)
      return std::numeric_limits<double>::infinity();
    return time_to_close(gap, rate, acceleration_);
  }

  /// How fast two triangles can close their gap along the direction n from a to b.
  double closing_rate(const TriangleCorners& s, const TriangleCorners& t, const Vec3& n) const {
    return speeds_a_.along(s, n) + speeds_b_.along(t, -n);
  }

  /// True where the search is over: the surfaces cross.
  bool visit(int ta, int tb, const TriangleCorners& t) {
    const TriangleCorners& s = a_.corners(ta);
    double time = time_of_plane(s, t, 1.0);
    if (time < best_.time) time = std::max(time, time_of_plane(t, s, -1.0));
    if (time >= best_.time) return false;
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
    }
    return d == 0.0;
  }

  struct NodePair {
    int a;
    int b;
    float gap;
    int visits;  ///< so far, when it was found to matter
  };

  /// Of both hierarchies at once, the larger node first, then the nearer pair.
  void descend() {
    NodePair stack[256];
    int top = 0;
    int visits = 0;
    stack[top++] = {0, 0, 0.0f, -1};
    while (top > 0) {
      NodePair pair = stack[--top];
      const detail::TurnedBox box_a = detail::turned(a_.oriented_box(pair.a));
      const detail::TurnedBox box_b = posed_.box(pair.b);
      if (pair.visits != visits && !matters(pair, box_a, box_b)) continue;
      const MeshBvh::Node& na = a_.nodes()[static_cast<std::size_t>(pair.a)];
      const MeshBvh::Node& nb = b_.nodes()[static_cast<std::size_t>(pair.b)];
      if (na.count > 0 && nb.count > 0) {
        if (visit_leaves(na, nb)) return;
        ++visits;
        continue;
      }
      const bool split_a =
          nb.count > 0 || (na.count == 0 && detail::largest(box_a.half) >= detail::largest(box_b.half));
      const int first = top;
      for (int child = 0; child < 2; ++child) {
        NodePair next = split_a ? NodePair{na.left + child, pair.b, 0.0f, visits}
                                : NodePair{pair.a, nb.left + child, 0.0f, visits};
        if (matters(next, split_a ? detail::turned(a_.oriented_box(next.a)) : box_a,
                    split_a ? box_b : posed_.box(next.b)))
          stack[top++] = next;
      }
      if (top == first + 2 && stack[first].gap < stack[first + 1].gap)
        std::swap(stack[first], stack[first + 1]);
    }
  }

  /// Whether what is in two boxes may come within the margin before the best time, as their axes and the
  /// field tell; sets the pair's gap.
  bool matters(NodePair& pair, const detail::TurnedBox& box_a, const detail::TurnedBox& box_b) {
    if (field_ && clearances_[static_cast<std::size_t>(pair.b)].known && field_keeps_away(pair.b, box_b))
      return false;
    const auto outlook =
        boxes_.look(box_a, box_b, static_cast<float>(best_.time), static_cast<float>(1.000001 * reserve()));
    pair.gap = outlook.gap;
    return !outlook.apart && !(field_ && field_keeps_away(pair.b, box_b));
  }

  bool field_keeps_away(int node, const detail::TurnedBox& box) {
    Clearance& c = clearances_[static_cast<std::size_t>(node)];
    if (!c.known) {
      const Vec3 center(box.center[0], box.center[1], box.center[2]);
      const double radius = radius_of(box);
      c = {certain_distance(*field_, center) - radius, speeds_b_.within(center, radius), true};
    }
    return c.gap > reserve() + best_.time * c.speed;
  }

  bool visit_leaves(const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    constexpr int most = 8;  // triangles of a leaf
    TriangleCorners ts[most];
    Box boxes[most];
    Box all;
    for (int j = 0; j < nb.count; ++j) {
      ts[j] = posed(b_.triangle_at(nb.left + j));
      boxes[j] = box_about(ts[j]);
      all.add(boxes[j]);
    }
    const Sweep sweep = sweep_of(centered(na.box), centered(all));
    for (int i = na.left; i < na.left + na.count; ++i) {
      const int ta = a_.triangle_at(i);
      const Box box_a = box_about(a_.corners(ta));
      if (stay_apart(box_a, all, sweep)) continue;
      for (int j = 0; j < nb.count; ++j)
        if (!stay_apart(box_a, boxes[j], sweep) && visit(ta, b_.triangle_at(nb.left + j), ts[j])) return true;
    }
    return false;
  }

  static Box box_about(const TriangleCorners& t) {
    return {t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c)};
  }

  const MeshBvh& a_;
  const MeshBvh& b_;
  const Pose& X_AB_;
  PointSpeeds speeds_a_;
  PointSpeeds speeds_b_;
  double acceleration_;
  double margin_;
  const DistanceField* field_;  ///< of a, at rest; may be absent
  detail::MovingBoxes boxes_;
  detail::PosedBoxes posed_;
  /// What the field says of a node of b.
  struct Clearance {
    double gap = 0.0;    ///< [m]
    double speed = 0.0;  ///< [m/s]
    bool known = false;
  };
  std::vector<Clearance> clearances_;
  FreeTime best_;
  PairHint nearest_;
};

}  // namespace

double time_to_close(double gap, double rate, double acceleration) {
  if (gap <= 0.0) return 0.0;
  const double root = std::sqrt(rate * rate + 2.0 * acceleration * gap);
  // gap = rate t + acceleration t^2 / 2; of the two forms of its solution the one without cancellation.
  if (rate >= 0.0) return root > 0.0 ? 2.0 * gap / (rate + root) : std::numeric_limits<double>::infinity();
  return acceleration > 0.0 ? (root - rate) / acceleration : std::numeric_limits<double>::infinity();
}

FreeTime compute_free_time(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                           double margin, double horizon, PairHint* hint, const DistanceField& field,
                           double touching) {
  if (a.empty() || b.empty()) return {horizon, std::numeric_limits<double>::infinity()};
  return FreeTimeSearch(a, b, X_AB, motion, margin, horizon, field).run(hint, touching);
}

}  // namespace eigengrasp
