// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/wire/message_makers.hpp"
#include "eigengrasp/grasp/named_joints.hpp"

#include <algorithm>
#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp::wire {

namespace {

constexpr double kFarthest = 1000.0;  // of what is drawn, as in the schema [m]
constexpr double kFinest = 1e6;       // parts of a metre that are drawn
constexpr double kLargest = 1e12;     // of other numbers, as in the schema

double drawn(double x) {
  return std::clamp(std::nearbyint(x * kFinest) / kFinest, -kFarthest, kFarthest);
}

Point drawn_point(const Vec3& p) {
  return {drawn(p.x()), drawn(p.y()), drawn(p.z())};
}

/// A direction keeps its digits.
Point direction(const Vec3& n) {
  return {n.x(), n.y(), n.z()};
}

double bounded(double x) {
  return std::isfinite(x) ? std::clamp(x, -kLargest, kLargest) : kLargest;
}

double not_negative(double x) {
  return std::max(0.0, bounded(x));
}

/// A name as the schema allows it: 1 to 64 characters.
std::string wire_name(const std::string& name) {
  if (name.empty()) return "unnamed";
  return name.substr(0, 64);
}

Contact contact_message(const GraspContact& contact) {
  return {drawn_point(contact.point.p_OC), direction(contact.point.n_OC), contact.point.mu,
          contact.point.torsion_length,    wire_name(contact.link),       contact.patch};
}

OnlineSolution bounded(OnlineSolution s) {
  s.epsilon = not_negative(s.epsilon);
  s.distance = std::clamp(bounded(s.distance), -kFarthest, kFarthest);
  s.angle = std::clamp(bounded(s.angle), 0.0, 7.0);
  s.offset = std::clamp(bounded(s.offset), 0.0, kFarthest);
  s.age = not_negative(s.age);
  return s;
}

}  // namespace

PoseNumbers pose_numbers(const Pose& X) {
  const Vec3 p = X.translation();
  const Eigen::Quaterniond q = orientation(X);
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

Pose to_pose(const PoseNumbers& n) {
  return make_pose({n[3], n[4], n[5], n[6]}, {n[0], n[1], n[2]});
}

PoseNumbers drawn_pose(const Pose& X) {
  PoseNumbers numbers = pose_numbers(X);
  std::transform(numbers.begin(), numbers.end(), numbers.begin(), drawn);
  return numbers;
}

LinkPoses link_poses(const HandModel& hand, const VecX& joints, const Pose& X_OH) {
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joints, X_OH, X_OL);
  LinkPoses poses(X_OL.size());
  std::transform(X_OL.begin(), X_OL.end(), poses.begin(), drawn_pose);
  return poses;
}

LinkPoses posture_poses(const HandModel& hand, const VecX& dofs, const Pose& X_OH) {
  return link_poses(hand, joint_values(hand, dofs), X_OH);
}

GraspShape grasp_shape(const HandModel& hand, const Grasp& grasp, int frames) {
  GraspShape shape;
  shape.form_closure = grasp.form_closure;
  shape.epsilon = not_negative(grasp.epsilon);
  shape.volume = not_negative(grasp.volume);
  shape.energy = bounded(grasp.energy);
  shape.max_penetration = std::clamp(bounded(grasp.max_penetration), -kFarthest, kFarthest);
  const VecX open = joints_by_name(hand, grasp.pregrasp_joints);
  const VecX closed = joints_by_name(hand, grasp.grasp_joints);
  for (int i = 0; i < frames; ++i) {
    const double share = static_cast<double>(i) / (frames - 1);
    shape.closing.push_back(link_poses(hand, (1.0 - share) * open + share * closed,
                                       interpolate(grasp.X_OH_pregrasp, grasp.X_OH, share)));
  }
  for (const GraspContact& contact : grasp.contacts) shape.contacts.push_back(contact_message(contact));
  return shape;
}

View::Offer offer_shape(const HandModel& hand, std::uint64_t id, const Grasp& grasp) {
  return {id, link_poses(hand, joints_by_name(hand, grasp.pregrasp_joints), grasp.X_OH_pregrasp),
          link_poses(hand, joints_by_name(hand, grasp.grasp_joints), grasp.X_OH)};
}

View view_message(const HandModel& hand, const OnlineView& view) {
  View m;
  m.frame = view.frame;
  m.time = not_negative(view.time);
  m.phase = view.phase;
  if (view.phase != OnlinePhase::waiting) m.wrist = {view.wrist.time, drawn_pose(view.wrist.X_OH)};
  m.blocked = view.blocked;
  m.link_poses = view.joints.size() == hand.n_joints() ? link_poses(hand, view.joints, view.X_OH)
                                                       : posture_poses(hand, hand.rest_posture(), view.X_OH);
  m.preshape = std::clamp(view.preshape, 0.0, 1.0);
  for (const OnlineSolution& s : view.solutions) m.solutions.push_back(bounded(s));
  m.cone = {drawn_point(view.cone.apex), direction(view.cone.axis),
            std::clamp(view.cone.half_angle, 0.0, 3.2), drawn(view.cone.nearest), drawn(view.cone.farthest)};
  m.rates = view.rates;
  m.rates.postures_per_second = not_negative(m.rates.postures_per_second);
  m.rates.candidates_per_second = not_negative(m.rates.candidates_per_second);
  m.rates.time_to_first_grasp = not_negative(m.rates.time_to_first_grasp);
  if (view.epsilon_now) m.epsilon_now = bounded(*view.epsilon_now);
  m.message = view.message;
  return m;
}

PlanResultMessage plan_result_message(const std::string& id, const HandModel& hand,
                                      const PlanResult& result) {
  PlanResultMessage m;
  m.id = id;
  m.status = result.status;
  m.stopped_early = result.stopped_early;
  m.explanation = result.explanation;
  for (const Grasp& grasp : result.grasps) m.grasps.push_back(grasp_shape(hand, grasp));
  m.counts = {result.states.evaluated,       result.states.legal,          result.candidates.tested,
              result.candidates.form_closed, result.candidates.not_closed, result.candidates.no_contact,
              result.candidates.penetrating};
  m.timings = {result.timings.prepare, result.timings.search, result.timings.close, result.timings.volume,
               result.timings.total};
  return m;
}

HandEntry hand_entry(const HandModel& hand, bool uploaded) {
  HandEntry entry;
  entry.name = hand.name;
  entry.title = hand.title.empty() ? hand.name : hand.title.substr(0, 200);
  entry.n_dof = hand.n_dof();
  entry.n_links = hand.n_links();
  entry.eigengrasps = hand.eigengrasps.size();
  for (const HandLink& link : hand.links) entry.links.push_back(wire_name(link.name));
  entry.rest = posture_poses(hand, hand.rest_posture(), Pose::Identity());
  entry.approach_point = drawn_point(hand.approach_point_H);
  entry.approach_direction = direction(hand.approach_direction_H);
  entry.reach = hand_reach(hand);
  for (const HandDof& dof : hand.dofs)
    entry.dofs.push_back({wire_name(dof.name), drawn(dof.min), drawn(dof.max)});
  for (int i = 0; i < hand.eigengrasps.size(); ++i) {
    const Eigengrasp& e = hand.eigengrasps[i];
    entry.amplitudes.push_back({wire_name(e.name), drawn(e.min), drawn(e.max)});
  }
  entry.uploaded = uploaded;
  return entry;
}

ObjectEntry object_entry(const std::string& name, const ObjectModel& object, bool uploaded) {
  const Box box = bounding_box(object.mesh);
  return {name,
          object.name.empty() ? name : object.name.substr(0, 200),
          static_cast<std::int64_t>(object.mesh.triangles.size()),
          drawn_point(box.size()),
          drawn_point(box.center()),
          uploaded};
}

WristSample wrist_sample(const Wrist& message) {
  return {message.time, to_pose(message.pose)};
}

std::vector<VariableTarget> variable_targets(const Targets& message) {
  std::vector<VariableTarget> targets;
  for (const Target& t : message.targets) targets.push_back({t.variable, t.index, t.value, t.confidence});
  return targets;
}

PlanOptions plan_options(const PlanStart& message) {
  PlanOptions o;
  o.iterations = message.options.iterations;
  o.grasps = message.options.grasps;
  o.seed = message.options.seed;
  o.search = message.options.search;
  o.energy = message.options.energy;
  o.amplitudes = message.options.amplitudes;
  return o;
}

OnlineOptions online_options(const OnlineStart& message) {
  OnlineOptions o;
  o.seed = message.options.seed;
  o.amplitudes = message.options.amplitudes;
  o.cone_half_angle = message.options.cone_half_angle;
  o.look_ahead = message.options.look_ahead;
  o.step_back = message.options.step_back;
  o.epsilon_min = message.options.epsilon_min;
  o.preshape_begins = message.options.preshape_begins;
  return o;
}

}  // namespace eigengrasp::wire
