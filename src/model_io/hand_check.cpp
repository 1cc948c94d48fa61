// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/hand_findings.hpp"

#include <algorithm>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

using Severity = HandFinding::Severity;

std::string severity_name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

std::vector<HandFinding> Findings::sorted() && {
  std::stable_sort(list_.begin(), list_.end(),
                   [](const HandFinding& a, const HandFinding& b) { return a.severity > b.severity; });
  return std::move(list_);
}

void check_closing(const HandModel& hand, Findings& findings) {
  if (hand.dofs.empty()) {
    findings.add(Severity::error,
                 "the hand has no degree of freedom, so it cannot take a posture; give it a "
                 "joint that is not of type fixed");
    return;
  }
  const bool closes = std::any_of(hand.dofs.begin(), hand.dofs.end(),
                                  [](const HandDof& dof) { return dof.closing_speed != 0.0; });
  if (!closes) {
    findings.add(Severity::error,
                 "no degree of freedom closes, so the fingers cannot be closed on an object; "
                 "give those that do a closing_speed, positive towards the upper limit");
  }
}

namespace {

void check_dof_range(const HandDof& dof, Findings& findings) {
  if (dof.min > dof.max) {
    findings.add(
        Severity::error,
        "degree of freedom {}: its limits {:.4g} to {:.4g} leave no value; mend the limits of its joints",
        dof.name, dof.min, dof.max);
  } else if (dof.max - dof.min < 1e-6) {
    findings.add(
        Severity::warning,
        "degree of freedom {}: its limits leave only the value {:.4g}, so it cannot move; widen the limits "
        "of its joints or make them fixed",
        dof.name, dof.min);
  } else if (dof.rest < dof.min - 1e-9 || dof.rest > dof.max + 1e-9) {
    findings.add(
        Severity::warning,
        "degree of freedom {}: its rest value {:.4g} is outside its limits {:.4g} to {:.4g}; move it "
        "inside",
        dof.name, dof.rest, dof.min, dof.max);
  }
}

}  // namespace

void check_limits(const HandModel& hand, Findings& findings) {
  for (const HandDof& dof : hand.dofs) check_dof_range(dof, findings);
  for (const HandJoint& joint : hand.joints) {
    if (joint.dof < 0) continue;
    const HandDof& dof = hand.dofs[static_cast<std::size_t>(joint.dof)];
    const double a = joint.ratio * dof.min + joint.offset, b = joint.ratio * dof.max + joint.offset;
    const double low = std::min(a, b), high = std::max(a, b);
    const double slack = 0.02 * (joint.max - joint.min) + 1e-6;
    if (low - joint.min > slack || joint.max - high > slack) {
      findings.add(
          Severity::note,
          "joint {}: its limits are {:.4g} to {:.4g}, but its coupling to {} lets it reach only {:.4g} to "
          "{:.4g}; widen the limits of the other joints of {} if it should reach more",
          joint.name, joint.min, joint.max, dof.name, low, high, dof.name);
    }
  }
}

void check_eigengrasps(const HandModel& hand, Findings& findings) {
  const EigengraspSpace& space = hand.eigengrasps;
  for (int d = 0; d < std::min(space.n_dof(), hand.n_dof()); ++d) {
    const HandDof& dof = hand.dofs[static_cast<std::size_t>(d)];
    if (space.origin()[d] < dof.min - 1e-6 || space.origin()[d] > dof.max + 1e-6) {
      findings.add(
          Severity::warning,
          "eigengrasps: the origin of {} is {:.4g}, outside its limits {:.4g} to {:.4g}; move it inside",
          dof.name, space.origin()[d], dof.min, dof.max);
    }
  }
  for (int i = 0; i < space.size(); ++i) {
    const Eigengrasp& e = space[i];
    const std::string name =
        e.name.empty() ? fmt::format("{}", i + 1) : fmt::format("{} ({})", i + 1, e.name);
    const VecX low = clamp_posture(hand, space.origin() + e.min * e.direction);
    const VecX high = clamp_posture(hand, space.origin() + e.max * e.direction);
    if ((high - low).cwiseAbs().maxCoeff() < 1e-3) {
      findings.add(
          Severity::warning,
          "eigengrasp {}: its amplitude range {:.4g} to {:.4g} moves no degree of freedom within the "
          "limits; widen the range or choose another direction",
          name, e.min, e.max);
    }
  }
}

std::vector<HandFinding> check_hand(const HandModel& hand) {
  Findings findings;
  const HandSurfaces surfaces = prepare_surfaces(hand);
  check_rest_collisions(hand, surfaces, findings);
  check_contacts(hand, surfaces, findings);
  check_closing(hand, findings);
  check_limits(hand, findings);
  check_eigengrasps(hand, findings);
  check_sizes(hand, surfaces, findings);
  check_meshes(hand, surfaces, findings);
  return std::move(findings).sorted();
}

}  // namespace eigengrasp
