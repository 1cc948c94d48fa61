// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/finger_closing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest_turn = 0.1;  // [rad or m] of a joint in one step: keeps the speed bound valid
constexpr double speed_reserve =
    1.1;  // a link moves away from an axis by at most largest_turn times its clearance

/// Two things that may touch: a link and the object, an obstacle, or another link.
struct Pair {
  enum class Kind { object, obstacle, links } kind;
  int link;
  int other;               ///< obstacle or second link
  double clearance = 0.0;  ///< lower bound [m]
  bool fresh = false;      ///< the clearance was computed at the present posture
  PairHint hint = {};
  double speed = 0.0;  ///< bound of the relative speed of surface points [m/s]
};

class FingerCloser {
 public:
  FingerCloser(const CollisionModel& model, const Pose& X_OH, const VecX& posture,
               const ClosingOptions& options)
      : model_(model), hand_(*model.scene().hand), X_OH_(X_OH), options_(options) {
    joints_ = joint_values(hand_, clamp_posture(hand_, posture));
    stopped_.assign(hand_.joints.size(), false);
    list_pairs();
    place(joints_);
  }

  ClosedHand run() {
    ClosedHand result;
    for (Pair& p : pairs_) measure(p);
    result.started_in_collision =
        std::any_of(pairs_.begin(), pairs_.end(), [](const Pair& p) { return p.clearance <= 0.0; });
    if (!result.started_in_collision) {
      while (result.steps < options_.max_steps && advance()) ++result.steps;
    }
    result.joints = joints_;
    result.dofs = posture_of_joints(hand_, joints_);
    result.X_OL = X_OL_;
    return result;
  }

 private:
  void list_pairs() {
    for (int i = 1; i < hand_.n_links(); ++i) {
      if (model_.surfaces().links[static_cast<std::size_t>(i)].empty()) continue;
      pairs_.push_back({Pair::Kind::object, i, 0});
      for (int k = 0; k < static_cast<int>(model_.scene().obstacles.size()); ++k)
        pairs_.push_back({Pair::Kind::obstacle, i, k});
    }
    for (const auto& [a, b] : hand_.collision_pairs) pairs_.push_back({Pair::Kind::links, a, b});
  }

  void place(const VecX& joints) { compute_link_poses(hand_, joints, X_OH_, X_OL_); }

  double distance(Pair& p, double exact_below) const {
    const Pose& X_OL = X_OL_[static_cast<std::size_t>(p.link)];
    switch (p.kind) {
      case Pair::Kind::object:
        return model_.distance_to_object(p.link, X_OL, exact_below, &p.hint);
      case Pair::Kind::obstacle:
        return model_.distance_to_obstacle(p.other, p.link, X_OL, exact_below, &p.hint);
      case Pair::Kind::links:
        return model_.distance_of_links(p.link, p.other, X_OL_, exact_below, &p.hint);
    }
    return 0.0;
  }

  void measure(Pair& p) {
    constexpr double exact_below = 0.010;
    p.clearance = distance(p, exact_below);
    p.fresh = true;
  }

  /// Joint velocities [rad/s] of all degrees of freedom that still move.
  VecX velocities() const {
    VecX v = VecX::Zero(hand_.n_joints());
    for (int d = 0; d < hand_.n_dof(); ++d) {
      const HandDof& dof = hand_.dofs[static_cast<std::size_t>(d)];
      if (dof.closing_speed == 0.0) continue;
      bool any_stopped = false;
      for (int j = 0; j < hand_.n_joints(); ++j)
        if (hand_.joints[static_cast<std::size_t>(j)].dof == d && blocked(j)) any_stopped = true;
      if (any_stopped && dof.type == DofType::rigid) continue;
      for (int j = 0; j < hand_.n_joints(); ++j) {
        const HandJoint& joint = hand_.joints[static_cast<std::size_t>(j)];
        if (joint.dof == d && !blocked(j)) v[j] = joint.ratio * dof.closing_speed;
      }
    }
    return v;
  }

  /// Value at which the joint's degree of freedom, or the joint itself, ends in closing direction.
  double end_of_travel(int j) const {
    const HandJoint& joint = hand_.joints[static_cast<std::size_t>(j)];
    const HandDof& dof = hand_.dofs[static_cast<std::size_t>(joint.dof)];
    const bool rises = joint.ratio * dof.closing_speed > 0.0;
    const double of_dof = joint.ratio * (dof.closing_speed > 0.0 ? dof.max : dof.min) + joint.offset;
    return rises ? std::min(of_dof, joint.max) : std::max(of_dof, joint.min);
  }

  bool blocked(int j) const {
    return stopped_[static_cast<std::size_t>(j)] || std::abs(end_of_travel(j) - joints_[j]) < 1e-9;
  }

  /// Largest speed that joint motion can give a point of a link, relative to what the same joint does not
  /// move.
  double speed_by(int j, int link, double rate) const {
    const HandJoint& joint = hand_.joints[static_cast<std::size_t>(j)];
    if (joint.type == JointType::prismatic) return std::abs(rate);
    const Pose& X_OJ = X_OL_[static_cast<std::size_t>(j) + 1];
    const Sphere& bound = model_.surfaces().links[static_cast<std::size_t>(link)].bound;
    const Vec3 arm = X_OL_[static_cast<std::size_t>(link)] * bound.center - X_OJ.translation();
    return std::abs(rate) * ((X_OJ.linear() * joint.axis_J).cross(arm).norm() + bound.radius);
  }

  double relative_speed(const Pair& p, const VecX& v) const {
    double speed = 0.0;
    for (int j = 0; j < hand_.n_joints(); ++j) {
      if (v[j] == 0.0) continue;
      const bool moves_a = moves_link(hand_, j, p.link);
      const bool moves_b = p.kind == Pair::Kind::links && moves_link(hand_, j, p.other);
      if (moves_a != moves_b) speed += speed_by(j, moves_a ? p.link : p.other, v[j]);
    }
    return speed_reserve * speed;
  }

  Vec3 velocity_of_point(int link, const Vec3& p_O, const VecX& v) const {
    Vec3 velocity = Vec3::Zero();
    for (int j = 0; j < hand_.n_joints(); ++j)
      if (v[j] != 0.0) velocity += v[j] * point_velocity(hand_, X_OL_, link, j, p_O);
    return velocity;
  }

  /// Whether the motion presses the pair together at one of the points in which it touches.
  bool presses(const Pair& p, const VecX& v) const {
    const MeshBvh& moving = model_.surfaces().links[static_cast<std::size_t>(p.link)].bvh;
    Pose X_OS = Pose::Identity();
    const MeshBvh* solid = &model_.scene().object->bvh;
    if (p.kind == Pair::Kind::obstacle) {
      const Obstacle& o = model_.scene().obstacles[static_cast<std::size_t>(p.other)];
      X_OS = o.X_OB;
      solid = &o.model->bvh;
    } else if (p.kind == Pair::Kind::links) {
      X_OS = X_OL_[static_cast<std::size_t>(p.other)];
      solid = &model_.surfaces().links[static_cast<std::size_t>(p.other)].bvh;
    }
    const Pose X_SL = X_OS.inverse() * X_OL_[static_cast<std::size_t>(p.link)];
    for (const TouchPoint& t : find_touch_points(*solid, moving, X_SL, 1.2 * options_.contact_gap)) {
      const Vec3 p_O = X_OS * t.p;
      Vec3 relative = velocity_of_point(p.link, p_O, v);
      if (p.kind == Pair::Kind::links) relative -= velocity_of_point(p.other, p_O, v);
      if (relative.dot(X_OS.linear() * t.n) > 1e-4 * p.speed) return true;
    }
    return false;
  }

  /// Stops the moving joints between the base and the pair's links.
  void stop(const Pair& p, const VecX& v) {
    for (int j = 0; j < hand_.n_joints(); ++j) {
      const bool moves_a = moves_link(hand_, j, p.link);
      const bool moves_b = p.kind == Pair::Kind::links && moves_link(hand_, j, p.other);
      if (v[j] != 0.0 && moves_a != moves_b) stopped_[static_cast<std::size_t>(j)] = true;
    }
  }

  /// Longest time until a joint reaches its end or has turned far.
  double time_to_limits(const VecX& v) const {
    double t = infinity;
    for (int j = 0; j < hand_.n_joints(); ++j)
      if (v[j] != 0.0)
        t = std::min({t, (end_of_travel(j) - joints_[j]) / v[j], largest_turn / std::abs(v[j])});
    return t;
  }

  bool touches(const Pair& p) const { return p.clearance <= options_.contact_gap; }

  /// One step. False when nothing moves any more.
  bool advance() {
    const VecX v = velocities();
    if (v.isZero(0.0)) return false;
    bool sliding = false;
    for (Pair& p : pairs_) {
      p.speed = relative_speed(p, v);
      if (p.speed == 0.0) continue;
      if (touches(p) && !p.fresh) measure(p);
      if (!touches(p)) continue;
      if (presses(p, v)) {
        stop(p, v);
        return true;
      }
      sliding = true;
    }
    double step = time_to_limits(v);
    if (sliding) step = std::min(step, options_.slide_step / v.cwiseAbs().maxCoeff());
    step = limit_by_clearance(step);
    if (sliding) return slide(v, step);
    move(v, step);
    return true;
  }

  /// Shortens the step so that no pair that does not touch yet comes nearer than half the contact gap.
  double limit_by_clearance(double step) {
    const auto allowed = [&](const Pair& p) { return (p.clearance - 0.5 * options_.contact_gap) / p.speed; };
    for (Pair& p : pairs_) {
      if (p.speed == 0.0 || touches(p) || allowed(p) >= step) continue;
      if (!p.fresh) measure(p);
      if (touches(p)) return 0.0;  // seen to at the beginning of the next step
      step = std::min(step, allowed(p));
    }
    return std::max(step, 0.0);
  }

  void move(const VecX& v, double step) {
    joints_ += step * v;
    for (int j = 0; j < hand_.n_joints(); ++j)
      if (v[j] != 0.0 && std::abs(end_of_travel(j) - joints_[j]) < 1e-9) joints_[j] = end_of_travel(j);
    place(joints_);
    for (Pair& p : pairs_) {
      if (p.speed == 0.0 || step == 0.0) continue;
      p.clearance = std::max(p.clearance - p.speed * step, 0.0);
      p.fresh = false;
    }
  }

  /// A step in which touching pairs may slide; where one would collide the step ends just before, and the
  /// pair stops its joints.
  bool slide(const VecX& v, double step) {
    std::vector<Pair*> touching;
    for (Pair& p : pairs_)
      if (p.speed > 0.0 && touches(p)) touching.push_back(&p);
    const VecX start = joints_;
    const auto first_collision = [&](double t) -> Pair* {
      place(start + t * v);
      for (Pair* p : touching)
        if (distance(*p, options_.contact_gap) <= 0.0) return p;
      return nullptr;
    };
    double free = 0.0;
    if (Pair* hit = first_collision(step)) {
      double collides = step;
      for (int i = 0; i < 24 && collides - free > 1e-7 / std::max(1e-9, v.cwiseAbs().maxCoeff()); ++i) {
        const double middle = 0.5 * (free + collides);
        if (Pair* p = first_collision(middle)) {
          collides = middle;
          hit = p;
        } else {
          free = middle;
        }
      }
      move(v, free);
      stop(*hit, v);
    } else {
      move(v, step);
    }
    for (Pair* p : touching) measure(*p);
    return true;
  }

  const CollisionModel& model_;
  const HandModel& hand_;
  Pose X_OH_;
  ClosingOptions options_;
  VecX joints_;
  std::vector<bool> stopped_;
  std::vector<Pair> pairs_;
  std::vector<Pose> X_OL_;
};

}  // namespace

ClosedHand close_fingers(const CollisionModel& model, const Pose& X_OH, const VecX& posture,
                         const ClosingOptions& options) {
  return FingerCloser(model, X_OH, posture, options).run();
}

}  // namespace eigengrasp
