// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"
#include "eigengrasp/planning/pregrasp_list.hpp"

namespace eigengrasp {

enum class CandidateOutcome { form_closed, not_closed, no_contact, penetrating };

/// Closes the fingers of a pre-grasp, finds the contacts, rates them, and checks the closed hand with exact
/// meshes. The volume is left out: see add_volume.
struct CandidateResult {
  CandidateOutcome outcome = CandidateOutcome::no_contact;
  Grasp grasp;    ///< provenance is the caller's
  int tests = 0;  ///< 0: the test was called off
};
CandidateResult test_candidate(const CollisionModel& model, const GraspEnergy& energy,
                               const PreGrasp& pregrasp);

/// Volume of the wrench space of a form-closed grasp; 0 for others. Cost: 0.2-5 ms.
void add_volume(const GraspEnergy& energy, Grasp& grasp);

/// The pre-grasp itself where it is free by exact meshes, or backed off by up to 2 mm against the approach
/// direction until it is; false where that does not help. Its energy is computed anew from exact distances.
bool make_exactly_legal(const CollisionModel& model, const GraspEnergy& energy, PreGrasp& pregrasp);

}  // namespace eigengrasp
