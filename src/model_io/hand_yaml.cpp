// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/hand_yaml.hpp"

#include <algorithm>
#include <set>

#include "model_io/hand_assembly.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

const std::vector<std::string> table_materials = {"glass",  "metal", "wood",        "plastic",
                                                  "rubber", "stone", "frictionless"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A link that a name means, directly or as a frame of it.
HandFrame require_link(const YamlValue& value, const HandModel& hand) {
  const std::string name = value.text();
  const int link = hand.find_link(name);
  if (link >= 0) return {name, link, Pose::Identity()};
  const int frame = hand.find_frame(name);
  if (frame >= 0) return hand.frames[static_cast<std::size_t>(frame)];
  std::vector<std::string> names;
  for (const HandLink& known : hand.links) names.push_back(known.name);
  for (const HandFrame& known : hand.frames) names.push_back(known.name);
  value.fail("{} is \"{}\", expected a link of the URDF{}", value.name(), value.written(),
             did_you_mean(name, names));
}

/// Values by degree of freedom, such as {index_mcp: 0.7}; what is not named is 0.
VecX read_posture(const YamlValue& value, const HandModel& hand) {
  VecX posture = VecX::Zero(hand.n_dof());
  const auto names = hand.dof_names();
  for (const auto& [name, number] : value.fields()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      number.fail("{} names \"{}\", expected a degree of freedom{}", value.name(), number.name(),
                  did_you_mean(name, names));
    }
    posture[found - names.begin()] = number.number();
  }
  return posture;
}

DofType read_dof_type(const YamlValue& value) {
  const std::string type = value.text();
  if (type == "rigid") return DofType::rigid;
  if (type == "breakaway") return DofType::breakaway;
  value.fail("type is \"{}\", expected rigid or breakaway{}", value.written(),
             did_you_mean(type, {"rigid", "breakaway"}));
}

/// Finds the degree of freedom that an item of `dofs` is about and fills in what it says.
HandDof read_dof(const YamlValue& item, const HandModel& hand, const Urdf& urdf) {
  item.fields({"joint", "closing_speed", "type", "rest"});
  const YamlValue joint = item.require("joint");
  const auto names = hand.dof_names();
  const auto found = std::find(names.begin(), names.end(), joint.text());
  if (found == names.end()) {
    const bool coupled = std::any_of(urdf.joints.begin(), urdf.joints.end(), [&](const UrdfJoint& j) {
      return j.name == joint.text() && (j.mimic || j.type == JointType::fixed);
    });
    joint.fail("joint is \"{}\", {}expected a joint of {} that moves on its own{}", joint.written(),
               coupled ? "which is fixed or mimics another, " : "", urdf.file.filename().string(),
               did_you_mean(joint.text(), names));
  }
  HandDof dof = hand.dofs[static_cast<std::size_t>(found - names.begin())];
  if (const auto speed = item.find("closing_speed")) dof.closing_speed = speed->number();
  if (const auto type = item.find("type")) dof.type = read_dof_type(*type);
  if (const auto rest = item.find("rest")) {
    dof.rest = rest->number();
    if (dof.rest < dof.min - 1e-9 || dof.rest > dof.max + 1e-9) {
      rest->fail("rest of {} is \"{}\", expected a value within its limits, {:.6g} to {:.6g}", dof.name,
                 rest->written(), dof.min, dof.max);
    }
  }
  return dof;
}

Material read_material(const std::string& name, const YamlValue& value) {
  Material material;
  material.name = name;
  value.fields({"friction", "youngs_modulus"});
  if (const auto friction = value.find("friction")) {
    material.friction = friction->number();
    if (*material.friction < 0.0) {
      friction->fail("friction is \"{}\", expected a number that is not negative", friction->written());
    }
  } else if (!contains(table_materials, name)) {
    value.fail("material {} has no friction, expected one (or one of the names that bring theirs: {})", name,
               join(table_materials));
  }
  if (const auto youngs = value.find("youngs_modulus")) {
    material.youngs_modulus = youngs->number();
    if (*material.youngs_modulus <= 0.0) {
      youngs->fail("youngs_modulus is \"{}\", expected a positive number of Pa", youngs->written());
    }
  }
  return material;
}

Material find_material(const YamlValue& value, const std::map<std::string, Material>& materials) {
  const std::string name = value.text();
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  if (contains(table_materials, name)) return {name, std::nullopt, std::nullopt};
  std::vector<std::string> known = table_materials;
  for (const auto& [own, material] : materials) known.push_back(own);
  value.fail("the material of {} is \"{}\", expected one of {}{}", value.name(), value.written(), join(known),
             did_you_mean(name, known));
}

Eigengrasp read_direction(const YamlValue& item, const HandModel& hand) {
  item.fields({"name", "range", "vector"});
  Eigengrasp e;
  if (const auto name = item.find("name")) e.name = name->text();
  if (const auto range = item.find("range")) {
    const auto values = range->numbers(2);
    e.min = values[0];
    e.max = values[1];
    if (e.min > e.max) range->fail("range is \"{}\", expected the smaller number first", range->written());
  }
  e.direction = read_posture(item.require("vector"), hand);
  return e;
}

}  // namespace

void read_dofs(const HandDocument& document, const Urdf& urdf, HandModel& hand) {
  const YamlValue& list = document.require("dofs");
  std::vector<HandDof> dofs;
  std::vector<int> new_index(hand.dofs.size(), -1);
  for (const YamlValue& item : list.items()) {
    HandDof dof = read_dof(item, hand, urdf);
    const auto names = hand.dof_names();
    const auto old =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), dof.name) - names.begin());
    if (new_index[old] >= 0) item.fail("{} names {} again, expected every joint once", item.name(), dof.name);
    new_index[old] = static_cast<int>(dofs.size());
    dofs.push_back(std::move(dof));
  }
  std::vector<std::string> missing;
  for (std::size_t d = 0; d < new_index.size(); ++d)
    if (new_index[d] < 0) missing.push_back(hand.dofs[d].name);
  if (!missing.empty()) {
    list.fail("dofs lists {} of the {} joints that move on their own, expected all: {} missing", dofs.size(),
              hand.n_dof(), join(missing));
  }
  hand.dofs = std::move(dofs);
  for (HandJoint& joint : hand.joints)
    if (joint.dof >= 0) joint.dof = new_index[static_cast<std::size_t>(joint.dof)];
}

void read_materials(const HandDocument& document, HandModel& hand) {
  std::map<std::string, Material> materials;
  if (const YamlValue* table = document.find("materials")) {
    for (const auto& [name, value] : table->fields()) materials[name] = read_material(name, value);
  }
  const YamlValue* links = document.find("link_materials");
  if (!links) return;
  if (const auto common = links->find("default")) {
    for (HandLink& link : hand.links) link.material = find_material(*common, materials);
  }
  for (const auto& [name, value] : links->fields()) {
    if (name == "default") continue;
    const int link = hand.find_link(name);
    if (link < 0) {
      std::vector<std::string> names{"default"};
      for (const HandLink& known : hand.links) names.push_back(known.name);
      value.fail("link_materials names \"{}\", expected a link of the URDF with a surface{}", value.name(),
                 did_you_mean(name, names));
    }
    hand.links[static_cast<std::size_t>(link)].material = find_material(value, materials);
  }
}

void read_approach(const HandDocument& document, HandModel& hand, const LogSink& log) {
  const YamlValue* approach = document.find("approach");
  if (!approach) {
    if (log) log(document.file.string() + ": has no approach; the hand comes along the base's z axis");
    return;
  }
  approach->fields({"point", "direction"});
  hand.approach_point_H = approach->require("point").vector();
  hand.approach_direction_H = approach->require("direction").direction();
}

void read_eigengrasps(const HandDocument& document, HandModel& hand, const LogSink& log) {
  const YamlValue* section = document.find("eigengrasps");
  if (!section) {
    if (log) log(document.file.string() + ": has no eigengrasps; every degree of freedom is a direction");
    hand.eigengrasps = all_postures(hand);
    return;
  }
  section->fields({"origin", "directions"});
  VecX origin = VecX::Zero(hand.n_dof());
  if (const auto value = section->find("origin")) origin = read_posture(*value, hand);
  const YamlValue directions = section->require("directions");
  std::vector<Eigengrasp> eigengrasps;
  for (const YamlValue& item : directions.items()) eigengrasps.push_back(read_direction(item, hand));
  if (eigengrasps.empty()) directions.fail("directions is empty, expected at least one");
  try {
    hand.eigengrasps = EigengraspSpace(origin, std::move(eigengrasps));
  } catch (const Error& e) {
    directions.fail("{}", e.what());
  }
}

void read_virtual_contacts(const HandDocument& document, HandModel& hand) {
  const YamlValue* list = document.find("virtual_contacts");
  if (!list) return;
  for (const YamlValue& item : list->items()) {
    item.fields({"link", "point", "normal"});
    const HandFrame frame = require_link(item.require("link"), hand);
    hand.virtual_contacts.push_back({frame.link, frame.X_LF * item.require("point").vector(),
                                     frame.X_LF.linear() * item.require("normal").direction()});
  }
}

void read_collision_pairs(const HandDocument& document, HandModel& hand) {
  std::vector<std::array<int, 2>> ignored;
  if (const YamlValue* list = document.find("ignore_collisions")) {
    for (const YamlValue& item : list->items()) {
      const auto pair = item.items();
      if (pair.size() != 2) item.fail("{} is \"{}\", expected two links", item.name(), item.written());
      ignored.push_back({require_link(pair[0], hand).link, require_link(pair[1], hand).link});
    }
  }
  set_collision_pairs(hand, ignored);
}

}  // namespace eigengrasp
