// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <optional>
#include <string>

#include "eigengrasp/model_io/hand_io.hpp"
#include "model_io/urdf_reader.hpp"
#include "model_io/yaml_file.hpp"

namespace eigengrasp {

/// The top-level keys of a hand.yaml and of those that it is based on; every value knows the file it is from.
struct HandDocument {
  std::filesystem::path file;
  std::map<std::string, YamlValue> keys;

  const YamlValue* find(const std::string& key) const;
  const YamlValue& require(const std::string& key) const;
};

/// Reads a hand.yaml with its chain of based_on, all of it in the folder `only_within` where that is not
/// empty.
/// @throws Error for unknown keys, versions, cycles.
HandDocument read_hand_document(const std::filesystem::path& file, const std::filesystem::path& only_within);

/// What of hand.yaml is read after the URDF, each into the hand. Order matters: dofs first.
void read_dofs(const HandDocument& document, const Urdf& urdf, HandModel& hand);
void read_materials(const HandDocument& document, HandModel& hand);
void read_approach(const HandDocument& document, HandModel& hand, const LogSink& log);
void read_eigengrasps(const HandDocument& document, HandModel& hand, const LogSink& log);
void read_virtual_contacts(const HandDocument& document, HandModel& hand);
void read_collision_pairs(const HandDocument& document, HandModel& hand);

}  // namespace eigengrasp
