// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/finger_closing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "planning/closing_motion.hpp"

namespace eigengrasp {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two things that may touch: a link and the object, an obstacle, or another link.
struct Pair {
  enum class Kind { object, obstacle, links } kind;
  int link;
  int other;                ///< obstacle or second link
  double free_until = 0.0;  ///< time up to which the two are sure to be apart [s]
  PairHint hint = {};
  int first_joint = 0;  ///< of its joints in the list of all pairs
  int n_joints = 0;
};

/// A joint between the two surfaces of a pair, from the second one outwards to the link.
struct PairJoint {
  int joint;
  double sign;   ///< -1 where it moves the second surface and not the link
  double reach;  ///< from its frame's origin to any point of the link, in any posture [m]
};

/// Each pair is looked at when the time runs out for which it was last found to be apart, and never else: a
/// free time holds whatever joints are stopped meanwhile.
class FingerCloser {
 public:
  FingerCloser(const CollisionModel& model, const Pose& X_OH, const VecX& posture,
               const ClosingOptions& options)
      : model_(model),
        hand_(*model.scene().hand),
        X_OH_(X_OH),
        options_(options),
        motion_(hand_, X_OH, posture) {
    if (motion_.fastest() > 0.0) tick_ = tick_turn / motion_.fastest();
    measure_hand();
    list_pairs();
  }

  ClosedHand run() {
    ClosedHand result;
    for (Pair& p : pairs_)
      if (look(p, 0.0).distance <= 0.0) result.started_in_collision = true;
    result.joints = motion_.joint_values(result.started_in_collision ? 0.0 : close(result.steps));
    result.dofs = posture_of_joints(hand_, result.joints);
    compute_link_poses(hand_, result.joints, X_OH_, result.X_OL);
    return result;
  }

 private:
  /// Time at which the hand is closed.
  double close(int& steps) {
    while (!pairs_.empty()) {
      Pair& next = *std::min_element(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
        return a.free_until < b.free_until;
      });
      const double t = next.free_until;
      if (!(t < motion_.end())) break;
      if (steps == options_.max_steps) return t;
      ++steps;
      const FreeTime free = look(next, t);
      if (free.distance > options_.contact_gap) continue;
      if (free.time < least_progress * tick_ || presses(next, t)) stop(next, t);
    }
    return motion_.end();
  }

  void measure_hand() {
    length_to_.assign(hand_.links.size(), 0.0);
    for (std::size_t j = 0; j < hand_.joints.size(); ++j) {
      const HandJoint& joint = hand_.joints[j];
      double length = joint.X_PJ.translation().norm();
      if (joint.type == JointType::prismatic) length += std::max(std::abs(joint.min), std::abs(joint.max));
      length_to_[j + 1] = length_to_[static_cast<std::size_t>(joint.parent_link)] + length;
    }
  }

  void list_pairs() {
    for (int i = 1; i < hand_.n_links(); ++i) {
      if (surface(i).empty()) continue;
      add_pair({Pair::Kind::object, i, 0});
      for (int k = 0; k < static_cast<int>(model_.scene().obstacles.size()); ++k)
        add_pair({Pair::Kind::obstacle, i, k});
    }
    for (const auto& [a, b] : hand_.collision_pairs) add_pair({Pair::Kind::links, b, a});
  }

  void add_pair(Pair p) {
    p.first_joint = static_cast<int>(pair_joints_.size());
    int b = p.link;
    int a = p.kind == Pair::Kind::links ? p.other : 0;
    const double extent = surface(p.link).bound.center.norm() + surface(p.link).bound.radius;
    const auto parent = [&](int link) {
      return hand_.joints[static_cast<std::size_t>(link - 1)].parent_link;
    };
    const auto length_to = [&](int link) { return length_to_[static_cast<std::size_t>(link)]; };
    std::vector<int> up;
    std::vector<int> down;
    while (a != b) {  // parents have smaller numbers: both come up to the link where the two branch
      int& further = a > b ? a : b;
      (a > b ? up : down).push_back(further);
      further = parent(further);
    }
    const auto add = [&](int link, double sign, double reach) {
      if (motion_.rate(link - 1, 0.0) != 0.0) pair_joints_.push_back({link - 1, sign, reach});
    };
    for (const int link : up)
      add(link, -1.0, length_to(link) - 2.0 * length_to(a) + length_to(p.link) + extent);
    for (auto link = down.rbegin(); link != down.rend(); ++link)
      add(*link, 1.0, length_to(p.link) - length_to(*link) + extent);
    p.n_joints = static_cast<int>(pair_joints_.size()) - p.first_joint;
    pairs_.push_back(p);
  }

  const HandSurfaces::LinkSurface& surface(int link) const {
    return model_.surfaces().links[static_cast<std::size_t>(link)];
  }

  const MeshBvh& other_surface(const Pair& p) const {
    switch (p.kind) {
      case Pair::Kind::obstacle:
        return model_.scene().obstacles[static_cast<std::size_t>(p.other)].model->bvh;
      case Pair::Kind::links:
        return surface(p.other).bvh;
      default:
        return model_.scene().object->bvh;
    }
  }

  Pose other_pose(const Pair& p, double t) {
    switch (p.kind) {
      case Pair::Kind::obstacle:
        return model_.scene().obstacles[static_cast<std::size_t>(p.other)].X_OB;
      case Pair::Kind::links:
        return motion_.pose(p.other, t);
      default:
        return Pose::Identity();
    }
  }

  /// How the link moves relative to the other surface, in the object's frame.
  SurfaceMotion relative_motion(const Pair& p, double t) {
    screws_.clear();
    double acceleration = 0.0;
    double turning = 0.0;  // of the joints so far
    for (int k = p.first_joint; k < p.first_joint + p.n_joints; ++k) {
      const PairJoint& pj = pair_joints_[static_cast<std::size_t>(k)];
      const double rate = pj.sign * motion_.rate(pj.joint, t);
      if (rate == 0.0) continue;
      const HandJoint& joint = hand_.joints[static_cast<std::size_t>(pj.joint)];
      const Pose& X_OJ = motion_.pose(pj.joint + 1, t);
      const Vec3 axis = rate * (X_OJ.linear() * joint.axis_J);
      if (joint.type == JointType::prismatic) {
        screws_.push_back({Vec3::Zero(), axis});
        acceleration += 2.0 * turning * std::abs(rate);
      } else {
        screws_.push_back({axis, X_OJ.translation().cross(axis)});
        acceleration += pj.reach * std::abs(rate) * (std::abs(rate) + 2.0 * turning);
        turning += std::abs(rate);
      }
    }
    return {screws_, acceleration};
  }

  /// Looks how long the pair is free from time t on.
  FreeTime look(Pair& p, double t) {
    const SurfaceMotion motion = relative_motion(p, t);
    FreeTime free;
    if (t > 0.0 && motion.joints.empty()) {
      p.free_until = infinity;
      return {infinity, infinity};
    }
    free.time = p.kind == Pair::Kind::links ? time_of_bounds(p, motion, t) : 0.0;
    if (free.time < tick_) free = time_of_surfaces(p, motion, t);
    p.free_until = t + free.time;
    // Pairs that are looked at together share the poses.
    if (free.time > tick_) p.free_until = std::floor(p.free_until / tick_) * tick_;
    return free;
  }

  double margin() const { return 0.5 * options_.contact_gap; }

  /// Free time of the two links' bounding spheres.
  double time_of_bounds(const Pair& p, const SurfaceMotion& motion, double t) {
    const Sphere& a = surface(p.other).bound;
    const Sphere& b = surface(p.link).bound;
    const Vec3 at = motion_.pose(p.link, t) * b.center;
    const Vec3 line = at - motion_.pose(p.other, t) * a.center;
    const double length = line.norm();
    const double gap = length - a.radius - b.radius - margin();
    if (gap <= 0.0) return 0.0;
    const Vec3 n = line / length;
    double rate = 0.0;
    for (const Screw& s : motion.joints)
      rate += std::max(0.0, b.radius * n.cross(s.angular).norm() - n.dot(s.velocity(at)));
    return time_to_close(gap, rate, motion.acceleration);
  }

  FreeTime time_of_surfaces(Pair& p, SurfaceMotion motion, double t) {
    const Pose& X_OL = motion_.pose(p.link, t);
    const double horizon = std::min(time_to_close(p.kind == Pair::Kind::object ? look_ahead2 : look_ahead,
                                                  speed(p, motion, t), motion.acceleration),
                                    horizon_ticks * tick_);
    if (p.kind == Pair::Kind::object)
      return compute_free_time(other_surface(p), surface(p.link).bvh, X_OL, motion, margin(), horizon,
                               &p.hint, model_.object_field());
    const Pose X_OS = other_pose(p, t);
    const Mat3 R_SO = X_OS.linear().transpose();
    for (Screw& s : screws_)  // those of the motion
      s = {R_SO * s.angular, R_SO * s.velocity(X_OS.translation())};
    return compute_free_time(other_surface(p), surface(p.link).bvh, X_OS.inverse() * X_OL, motion, margin(),
                             horizon, &p.hint);
  }

  /// Bound of the speed of the link's points [m/s].
  double speed(const Pair& p, const SurfaceMotion& motion, double t) {
    const Sphere& bound = surface(p.link).bound;
    const Vec3 middle = motion_.pose(p.link, t) * bound.center;
    double speed = 0.0;
    for (const Screw& s : motion.joints) speed += s.velocity(middle).norm() + bound.radius * s.angular.norm();
    return speed;
  }

  /// Whether the motion presses the pair together at one of the points in which it touches.
  bool presses(const Pair& p, double t) {
    const Pose X_OS = other_pose(p, t);
    const Pose X_SL = X_OS.inverse() * motion_.pose(p.link, t);
    const auto touches =
        find_touch_points(other_surface(p), surface(p.link).bvh, X_SL, 1.2 * options_.contact_gap);
    const SurfaceMotion motion = relative_motion(p, t);
    const double least = 1e-4 * speed(p, motion, t);
    return std::any_of(touches.begin(), touches.end(), [&](const TouchPoint& touch) {
      Vec3 velocity = Vec3::Zero();
      for (const Screw& s : motion.joints) velocity += s.velocity(X_OS * touch.p);
      return velocity.dot(X_OS.linear() * touch.n) > least;
    });
  }

  /// Stops the moving joints between the pair's links, or between the link and the base.
  void stop(Pair& p, double t) {
    for (int k = p.first_joint; k < p.first_joint + p.n_joints; ++k)
      motion_.stop(pair_joints_[static_cast<std::size_t>(k)].joint, t);
    p.free_until = infinity;
  }

  static constexpr double tick_turn = 0.05;  // [rad or m] of the fastest joint
  static constexpr double look_ahead2 = 0.005;
  static constexpr double look_ahead = 0.004;
  static constexpr double horizon_ticks = 4.0;
  static constexpr double least_progress = 1e-5;  // ticks: a slide that gets no further ends

  const CollisionModel& model_;
  const HandModel& hand_;
  Pose X_OH_;
  ClosingOptions options_;
  ClosingMotion motion_;
  double tick_ = infinity;
  std::vector<double> length_to_;  ///< of the straightened chain from the base to each link [m]
  std::vector<Pair> pairs_;
  std::vector<PairJoint> pair_joints_;
  std::vector<Screw> screws_;
};

}  // namespace

ClosedHand close_fingers(const CollisionModel& model, const Pose& X_OH, const VecX& posture,
                         const ClosingOptions& options) {
  return FingerCloser(model, X_OH, posture, options).run();
}

}  // namespace eigengrasp
