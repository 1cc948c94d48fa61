// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/candidate_test.hpp"

#include <cmath>

#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/grasp/named_joints.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/finger_closing.hpp"

namespace eigengrasp {

namespace {

constexpr double deepest_allowed = 0.0005;  // [m]

}  // namespace

CandidateResult test_candidate(const CollisionModel& model, const GraspEnergy& energy,
                               const PreGrasp& pregrasp) {
  const HandModel& hand = *model.scene().hand;
  CandidateResult result;
  Grasp& g = result.grasp;
  g.hand = hand.name;
  g.object = model.scene().object->name;
  g.X_OH_pregrasp = g.X_OH = pregrasp.X_OH;
  g.pregrasp_dofs = pregrasp.dofs;
  g.pregrasp_joints = named_joints(hand, joint_values(hand, pregrasp.dofs));
  g.amplitudes = pregrasp.amplitudes;
  g.energy = pregrasp.energy;

  const ClosedHand closed = close_fingers(model, pregrasp.X_OH, pregrasp.dofs);
  g.grasp_dofs = closed.dofs;
  g.grasp_joints = named_joints(hand, closed.joints);
  g.contacts = find_contacts(model, closed.X_OL, {}, &closed.proximity);
  if (g.contacts.empty()) return result;

  // One contact never closes.
  const auto points = contact_points(g.contacts);
  const WrenchSpaceQuality quality =
      points.size() < 2 ? WrenchSpaceQuality{} : compute_epsilon(points, energy.wrench_space());
  g.epsilon = quality.epsilon;
  g.form_closure = quality.form_closure;
  g.max_penetration = model.deepest_penetration(closed.X_OL, &closed.proximity);
  if (g.max_penetration > deepest_allowed) {
    g.form_closure = false;
    result.outcome = CandidateOutcome::penetrating;
    return result;
  }
  result.outcome = quality.form_closure ? CandidateOutcome::form_closed : CandidateOutcome::not_closed;
  return result;
}

void add_volume(const GraspEnergy& energy, Grasp& grasp) {
  grasp.volume =
      grasp.form_closure ? compute_volume(contact_points(grasp.contacts), energy.wrench_space()) : 0.0;
}

namespace {

/// Writes and reads the pose until it comes back with the same bits. False where it does not soon.
bool settles(Pose& X) {
  for (int i = 0; i < 16; ++i) {
    const Pose again = make_pose(orientation(X), X.translation());
    if (again.matrix() == X.matrix()) return true;
    X = again;
  }
  return false;
}

/// A pose next to X that a file, which keeps a quaternion, brings back with the same bits: only from the same
/// bits closing ends at the same place. Of eight poses one goes round in circles; it is begun anew from a
/// quaternion rounded to 44 bits, then 43, and so on.
Pose as_written(const Pose& X) {
  Pose written = X;
  for (int bits = 44; bits > 24 && !settles(written); --bits) {
    const double unit = std::ldexp(1.0, -bits);
    Eigen::Quaterniond q = orientation(X);
    q.coeffs() = (q.coeffs() / unit).array().round().matrix() * unit;
    written = make_pose(q, X.translation());
  }
  return written;
}

}  // namespace

bool make_exactly_legal(const CollisionModel& model, const GraspEnergy& energy, PreGrasp& pregrasp) {
  constexpr double step = 0.00025;  // [m]
  constexpr int most_steps = 8;
  const HandModel& hand = *model.scene().hand;
  const VecX joints = joint_values(hand, pregrasp.dofs);
  std::vector<Pose> X_OL;
  for (int i = 0; i <= most_steps; ++i) {
    const Pose X_OH = as_written(pregrasp.X_OH * Eigen::Translation3d(-i * step * hand.approach_direction_H));
    compute_link_poses(hand, joints, X_OH, X_OL);
    if (model.check_exact(X_OL) != Legality::legal) continue;
    std::vector<ContactApproach> approaches;
    pregrasp.X_OH = X_OH;
    pregrasp.energy = energy.evaluate(X_OL, DistanceSource::exact, approaches);
    return true;
  }
  return false;
}

}  // namespace eigengrasp
