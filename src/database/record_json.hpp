// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <nlohmann/json.hpp>

#include "eigengrasp/database/store_records.hpp"

namespace eigengrasp {

// The lines of a text store (docs/grasp-store.md). Numbers keep all their bits. Reading throws nlohmann's
// exceptions for members that are missing or of another type.
nlohmann::ordered_json to_line(const StoredModel& model);
nlohmann::ordered_json to_line(const StoredHand& hand);
nlohmann::ordered_json to_line(const GraspSource& source);
nlohmann::ordered_json to_line(const StoredDescriptor& descriptor);
nlohmann::ordered_json to_line(const StoredNeighbor& neighbor);
nlohmann::ordered_json to_line(const StoredAlignment& alignment);
nlohmann::ordered_json to_line(const StoredGrasp& grasp);  ///< without hand, object, scale and id

void from_line(const nlohmann::ordered_json& line, StoredModel& model);
void from_line(const nlohmann::ordered_json& line, StoredHand& hand);
void from_line(const nlohmann::ordered_json& line, GraspSource& source);
void from_line(const nlohmann::ordered_json& line, StoredDescriptor& descriptor);
void from_line(const nlohmann::ordered_json& line, StoredNeighbor& neighbor);
void from_line(const nlohmann::ordered_json& line, StoredAlignment& alignment);
void from_line(const nlohmann::ordered_json& line, StoredGrasp& grasp);

}  // namespace eigengrasp
