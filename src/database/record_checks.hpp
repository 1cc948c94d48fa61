// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/database/store_records.hpp"

namespace eigengrasp {

// Each throws Error, one sentence, for a record that no store may hold.
void require_name(const std::string& name, const char* what);
void require_sound(const StoredModel& model);
void require_sound(const StoredHand& hand);
void require_sound(const UnitResult& result);
void require_sound(const StoredDescriptor& descriptor);
void require_sound(const StoredNeighbor& neighbor);
void require_sound(const StoredAlignment& alignment);
/// Finite numbers, and of the unit's object, scale and hand.
void require_sound(const UnitKey& key, const std::vector<StoredGrasp>& grasps);
/// The worker's name and a finite number of seconds.
void require_claim(const std::string& worker, double lease_seconds);

/// A model of the same name with another content is an Error; scales may differ.
void require_same(const StoredModel& there, const StoredModel& added);
void require_same(const StoredHand& there, const StoredHand& added);
void require_same(const GraspSource& there, const GraspSource& added);

/// "glass at scale 1.25 with barrett-metal"
std::string describe(const UnitKey& key);

}  // namespace eigengrasp
