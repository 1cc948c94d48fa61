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
  int other;       ///< obstacle or second link
  int number = 0;  ///< in the list of all
  SeparationFront front = {};
  int first_joint = 0;  ///< of the joints that move the other surface, then the link, in the list of all
  int first_of_link = 0;
  int end_joint = 0;
  double distance = infinity;   ///< [m] of the triangles that limited the last look at the meshes
  double clearance = infinity;  ///< distance [m] that the two are sure to keep, as all looks have told
};

/// Index of the least value, of the first where there are several; in a form for vector registers.
std::size_t first_of_least(const std::vector<double>& values) {
  constexpr std::size_t width = 8;
  double least[width];
  std::fill(least, least + width, infinity);
  std::size_t i = 0;
  for (; i + width <= values.size(); i += width)
    for (std::size_t k = 0; k < width; ++k) least[k] = values[i + k] < least[k] ? values[i + k] : least[k];
  for (; i < values.size(); ++i) least[0] = std::min(least[0], values[i]);
  const auto found = std::find(values.begin(), values.end(), *std::min_element(least, least + width));
  return static_cast<std::size_t>(found - values.begin());
}

/// A joint that moves one surface of a pair and not the other; each surface's from the base outwards.
struct PairJoint {
  int joint;
  double reach;  ///< from its frame's origin to any point of the surface, in any posture [m]
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
    if (!result.started_in_collision) result.proximity = take_proximity();
    return result;
  }

 private:
  /// Time at which the hand is closed.
  double close(int& steps) {
    while (!pairs_.empty()) {
      const std::size_t soonest = first_of_least(free_until_);
      const double t = free_until_[soonest];
      if (!(t < motion_.end())) break;
      if (steps == options_.max_steps) return t;
      ++steps;
      Pair& next = pairs_[soonest];
      if (look(next, t, options_.contact_gap).distance > options_.contact_gap) continue;
      // Where they touch, either the motion presses, or they slide as far as that is free.
      if (presses(next, t) || look(next, t).time < least_progress * tick_) stop(next, t);
    }
    return motion_.end();
  }

  /// Each pair was looked at until it was sure to stay apart to the end, or its contact had stopped it.
  HandProximity take_proximity() {
    HandProximity known;
    const std::size_t n_links = hand_.links.size();
    known.object_fronts.resize(n_links);
    known.object_clearance.resize(n_links, 0.0);
    known.obstacle_clearance.resize(n_links * model_.scene().obstacles.size(), 0.0);
    for (Pair& p : pairs_) {
      const auto link = static_cast<std::size_t>(p.link);
      switch (p.kind) {
        case Pair::Kind::object:
          known.object_clearance[link] = p.clearance;
          known.object_fronts[link] = std::move(p.front);
          break;
        case Pair::Kind::obstacle:
          known.obstacle_clearance[static_cast<std::size_t>(p.other) * n_links + link] = p.clearance;
          break;
        case Pair::Kind::links:  // in the order of the hand's list
          known.pair_clearance.push_back(p.clearance);
          break;
      }
    }
    return known;
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
    int common = 0;  // the link from which the branches of both start
    if (p.kind == Pair::Kind::links) {
      common = p.link;
      for (int other = p.other; common != other;)  // parents have smaller numbers
        (common > other ? common : other) = parent(std::max(common, other));
    }
    p.first_joint = static_cast<int>(pair_joints_.size());
    if (p.kind == Pair::Kind::links) add_branch(common, p.other);
    p.first_of_link = static_cast<int>(pair_joints_.size());
    add_branch(common, p.link);
    p.end_joint = static_cast<int>(pair_joints_.size());
    p.number = static_cast<int>(pairs_.size());
    pairs_.push_back(p);
    free_until_.push_back(0.0);
  }

  /// The joints that move between a link and one further up.
  void add_branch(int from, int to) {
    const Sphere& bound = surface(to).bound;
    const auto first = static_cast<std::ptrdiff_t>(pair_joints_.size());
    for (int link = to; link != from; link = parent(link)) {
      const double length =
          length_to_[static_cast<std::size_t>(to)] - length_to_[static_cast<std::size_t>(link)];
      if (motion_.rate(link - 1, 0.0) != 0.0)
        pair_joints_.push_back({link - 1, length + bound.center.norm() + bound.radius});
    }
    std::reverse(pair_joints_.begin() + first, pair_joints_.end());
  }

  int parent(int link) const { return hand_.joints[static_cast<std::size_t>(link - 1)].parent_link; }

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

  /// Of the other surface, where it is at rest and has one; else empty.
  const DistanceField& field(const Pair& p) const {
    static const DistanceField none;
    return p.kind == Pair::Kind::object ? model_.object_field() : none;
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

  /// How the two surfaces move, in the object's frame.
  SurfaceMotion motion_of(const Pair& p, double t) {
    screws_a_.clear();
    screws_b_.clear();
    double acceleration = add_screws(p.first_joint, p.first_of_link, t, screws_a_);
    acceleration += add_screws(p.first_of_link, p.end_joint, t, screws_b_);
    return {screws_a_, screws_b_, acceleration};
  }

  /// Returns a bound of what a point's acceleration ever comes to.
  double add_screws(int first, int end, double t, std::vector<Screw>& screws) {
    double acceleration = 0.0;
    double turning = 0.0;  // of the joints so far
    for (int k = first; k < end; ++k) {
      const PairJoint& pj = pair_joints_[static_cast<std::size_t>(k)];
      const double rate = motion_.rate(pj.joint, t);
      if (rate == 0.0) continue;
      const HandJoint& joint = hand_.joints[static_cast<std::size_t>(pj.joint)];
      const Pose& X_OJ = motion_.pose(pj.joint + 1, t);
      const Vec3 axis = rate * (X_OJ.linear() * joint.axis_J);
      if (joint.type == JointType::prismatic) {
        screws.push_back({Vec3::Zero(), axis});
        acceleration += 2.0 * turning * std::abs(rate);
      } else {
        screws.push_back({axis, X_OJ.translation().cross(axis)});
        acceleration += pj.reach * std::abs(rate) * (std::abs(rate) + 2.0 * turning);
        turning += std::abs(rate);
      }
    }
    return acceleration;
  }

  /// Looks how long the pair is free from time t on, or only whether it touches where it is seen to.
  FreeTime look(Pair& p, double t, double touching = -1.0) {
    const SurfaceMotion motion = motion_of(p, t);
    FreeTime free{infinity, infinity};
    double& free_until = free_until_[static_cast<std::size_t>(p.number)];
    free_until = infinity;
    if (t == 0.0 || !motion.still()) {
      const double horizon = horizon_of(p, motion, t);
      if (const double known = time_of_quick_look(p, motion, t, horizon); known > 0.0) {
        free.time = known;
        free_until = t + known;
        p.clearance = std::min(p.clearance, margin());
      } else {
        free = time_of_surfaces(p, motion, t, horizon, touching);
        free_until = p.front.free_until();
        p.clearance = std::min(p.clearance, p.front.clearance());
        p.distance = free.distance;
      }
    }
    // Pairs that are looked at together share the poses.
    if (free_until > t + tick_) free_until = std::floor(free_until / tick_) * tick_;
    return free;
  }

  double margin() const { return 0.5 * options_.contact_gap; }

  /// For how long a look is worth its cost.
  double horizon_of(const Pair& p, const SurfaceMotion& motion, double t) {
    return std::min(time_to_close(look_ahead, speed(p, motion, t), motion.acceleration),
                    horizon_ticks * tick_);
  }

  double time_of_bounds(const Pair& p, const SurfaceMotion& motion, double t) {
    const Sphere& a = surface(p.other).bound;
    const Sphere& b = surface(p.link).bound;
    const Vec3 at_a = motion_.pose(p.other, t) * a.center;
    const Vec3 at_b = motion_.pose(p.link, t) * b.center;
    const double length = (at_b - at_a).norm();
    const double gap = length - a.radius - b.radius - margin();
    if (gap <= 0.0) return 0.0;
    const Vec3 n = (at_b - at_a) / length;
    double rate = 0.0;
    for (const Screw& s : motion.of_a)
      rate += std::max(0.0, a.radius * n.cross(s.angular).norm() + n.dot(s.velocity(at_a)));
    for (const Screw& s : motion.of_b)
      rate += std::max(0.0, b.radius * n.cross(s.angular).norm() - n.dot(s.velocity(at_b)));
    return time_to_close(gap, rate, motion.acceleration);
  }

  /// For how long balls about the surfaces tell that the pair is free, at little cost; 0 where that is too
  /// short a time to spare a look at the surfaces.
  double time_of_quick_look(const Pair& p, const SurfaceMotion& motion, double t, double horizon) {
    double known = 0.0;
    double least = horizon;
    if (p.kind == Pair::Kind::links) {
      known = time_of_bounds(p, motion, t);
    } else if (p.kind == Pair::Kind::object && !(p.distance < near)) {
      least = horizon * (balls_look_ahead / look_ahead);
      known = surface(p.link).cover.free_time(model_.object_field(), motion_.pose(p.link, t), motion,
                                              margin(), balls_horizons * horizon, least);
    }
    return known >= least ? known : 0.0;
  }

  FreeTime time_of_surfaces(Pair& p, const SurfaceMotion& motion, double t, double horizon, double touching) {
    const Pose& X_OL = motion_.pose(p.link, t);
    const MeshBvh& link = surface(p.link).bvh;
    if (p.kind == Pair::Kind::object)
      return p.front.look(other_surface(p), link, X_OL, motion, t, margin(), horizon, field(p), touching);
    const Pose X_OS = other_pose(p, t);
    const Mat3 R_SO = X_OS.linear().transpose();
    for (std::vector<Screw>* screws :
         {&screws_a_, &screws_b_})  // those of the motion, in the surface's frame
      for (Screw& s : *screws) s = {R_SO * s.angular, R_SO * s.velocity(X_OS.translation())};
    return p.front.look(other_surface(p), link, X_OS.inverse() * X_OL, motion, t, margin(), horizon, field(p),
                        touching);
  }

  /// Bound of the speed at which points of the two come together [m/s].
  double speed(const Pair& p, const SurfaceMotion& motion, double t) {
    const auto of = [&](int link, std::span<const Screw> joints) {
      const Sphere& bound = surface(link).bound;
      const Vec3 middle = motion_.pose(link, t) * bound.center;
      double sum = 0.0;
      for (const Screw& s : joints) sum += s.velocity(middle).norm() + bound.radius * s.angular.norm();
      return sum;
    };
    return of(p.link, motion.of_b) + (motion.of_a.empty() ? 0.0 : of(p.other, motion.of_a));
  }

  /// Whether the motion presses the pair together at one of the points in which it touches.
  bool presses(const Pair& p, double t) {
    const Pose X_OS = other_pose(p, t);
    const Pose X_SL = X_OS.inverse() * motion_.pose(p.link, t);
    const SurfaceMotion motion = motion_of(p, t);
    const double least = 1e-4 * speed(p, motion, t);
    const auto pressed = [&](const TouchPoint& touch) {
      Vec3 velocity = Vec3::Zero();
      for (const Screw& s : motion.of_b) velocity += s.velocity(X_OS * touch.p);
      for (const Screw& s : motion.of_a) velocity -= s.velocity(X_OS * touch.p);
      return velocity.dot(X_OS.linear() * touch.n) > least;
    };
    const double reach = 1.2 * options_.contact_gap;
    const MeshBvh& link = surface(p.link).bvh;
    // Mostly the triangles that were seen to touch tell.
    return std::ranges::any_of(find_touch_points(other_surface(p), link, X_SL, reach, p.front.nearest()),
                               pressed) ||
           std::ranges::any_of(find_touch_points(other_surface(p), link, X_SL, reach, field(p), p.front),
                               pressed);
  }

  /// Stops the moving joints between the pair's links, or between the link and the base.
  void stop(Pair& p, double t) {
    for (int k = p.first_joint; k < p.end_joint; ++k)
      motion_.stop(pair_joints_[static_cast<std::size_t>(k)].joint, t);
    free_until_[static_cast<std::size_t>(p.number)] = infinity;
  }

  static constexpr double tick_turn = 0.05;           // [rad or m] of the fastest joint
  static constexpr double look_ahead = 0.002;         // [m] of motion: further is dear to search
  static constexpr double balls_look_ahead = 0.0003;  // [m] of motion that a look at balls must tell
  static constexpr double balls_horizons = 4.0;       // for so many a look at balls goes on
  static constexpr double near = 0.001;               // [m] where balls have nothing to tell
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
  std::vector<double> free_until_;  ///< of each pair, time up to which the two are sure to be apart [s]
  std::vector<PairJoint> pair_joints_;
  std::vector<Screw> screws_a_;
  std::vector<Screw> screws_b_;
};

}  // namespace

ClosedHand close_fingers(const CollisionModel& model, const Pose& X_OH, const VecX& posture,
                         const ClosingOptions& options) {
  return FingerCloser(model, X_OH, posture, options).run();
}

}  // namespace eigengrasp
