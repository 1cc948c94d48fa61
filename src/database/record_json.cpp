// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/record_json.hpp"

#include <span>

namespace eigengrasp {

using Json = nlohmann::ordered_json;

namespace {

using Rows34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
using Rows44 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Json numbers(std::span<const double> values) {
  return Json(std::vector<double>(values.begin(), values.end()));
}

void read_numbers(const Json& json, std::span<double> into) {
  const auto values = json.get<std::vector<double>>();
  if (values.size() != into.size())
    throw nlohmann::json::type_error::create(302, "an array has another number of elements", nullptr);
  std::copy(values.begin(), values.end(), into.begin());
}

Json pose_json(const Pose& X) {
  const Rows34 rows = X.matrix().topRows<3>();
  return numbers({rows.data(), 12});
}

Pose read_pose(const Json& json) {
  Rows34 rows;
  read_numbers(json, {rows.data(), 12});
  Pose X = Pose::Identity();
  X.matrix().topRows<3>() = rows;
  return X;
}

VecX read_vector(const Json& json) {
  const auto values = json.get<std::vector<double>>();
  return Eigen::Map<const VecX>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// A hand's state: pose, joints by name, degrees of freedom.
Json state_json(const Pose& X_OH, const NamedValues& joints, const VecX& dofs) {
  Json named = Json::array();
  for (const auto& [name, value] : joints) named.push_back(Json::array({name, value}));
  return {{"pose", pose_json(X_OH)},
          {"joints", named},
          {"dofs", numbers({dofs.data(), static_cast<std::size_t>(dofs.size())})}};
}

void read_state(const Json& json, Pose& X_OH, NamedValues& joints, VecX& dofs) {
  X_OH = read_pose(json.at("pose"));
  for (const Json& pair : json.at("joints"))
    joints.emplace_back(pair.at(0).get<std::string>(), pair.at(1).get<double>());
  dofs = read_vector(json.at("dofs"));
}

Json contact_json(const GraspContact& c) {
  return {{"link", c.link},
          {"patch", c.patch},
          {"position", numbers({c.point.p_OC.data(), 3})},
          {"normal", numbers({c.point.n_OC.data(), 3})},
          {"mu", c.point.mu},
          {"torsion_length", c.point.torsion_length}};
}

GraspContact read_contact(const Json& json) {
  GraspContact c;
  json.at("link").get_to(c.link);
  json.at("patch").get_to(c.patch);
  read_numbers(json.at("position"), {c.point.p_OC.data(), 3});
  read_numbers(json.at("normal"), {c.point.n_OC.data(), 3});
  json.at("mu").get_to(c.point.mu);
  json.at("torsion_length").get_to(c.point.torsion_length);
  return c;
}

}  // namespace

Json to_line(const StoredModel& m) {
  return {{"name", m.name},
          {"geometry_path", m.geometry_path},
          {"content_hash", m.content_hash},
          {"tags", m.tags},
          {"rescale", m.rescale},
          {"approximate_radius", m.approximate_radius},
          {"thumbnail_path", m.thumbnail_path},
          {"scales", m.scales}};
}

void from_line(const Json& line, StoredModel& m) {
  line.at("name").get_to(m.name);
  line.at("geometry_path").get_to(m.geometry_path);
  line.at("content_hash").get_to(m.content_hash);
  line.at("tags").get_to(m.tags);
  line.at("rescale").get_to(m.rescale);
  line.at("approximate_radius").get_to(m.approximate_radius);
  line.at("thumbnail_path").get_to(m.thumbnail_path);
  line.at("scales").get_to(m.scales);
}

Json to_line(const StoredHand& h) {
  return {{"name", h.name}, {"joints", h.joints}, {"dofs", h.dofs}, {"links", h.links}};
}

void from_line(const Json& line, StoredHand& h) {
  line.at("name").get_to(h.name);
  line.at("joints").get_to(h.joints);
  line.at("dofs").get_to(h.dofs);
  line.at("links").get_to(h.links);
}

Json to_line(const GraspSource& s) {
  return {{"name", s.name}, {"description", s.description}};
}

void from_line(const Json& line, GraspSource& s) {
  line.at("name").get_to(s.name);
  line.at("description").get_to(s.description);
}

Json to_line(const StoredDescriptor& d) {
  return {{"model", d.model},   {"function", d.function},
          {"route", d.route},   {"center", numbers({d.center.data(), 3})},
          {"radius", d.radius}, {"invariants", d.invariants}};
}

void from_line(const Json& line, StoredDescriptor& d) {
  line.at("model").get_to(d.model);
  line.at("function").get_to(d.function);
  line.at("route").get_to(d.route);
  read_numbers(line.at("center"), {d.center.data(), 3});
  line.at("radius").get_to(d.radius);
  line.at("invariants").get_to(d.invariants);
}

Json to_line(const StoredNeighbor& n) {
  return {{"model", n.model},
          {"neighbor", n.neighbor},
          {"distance_function", n.distance_function},
          {"distance", n.distance}};
}

void from_line(const Json& line, StoredNeighbor& n) {
  line.at("model").get_to(n.model);
  line.at("neighbor").get_to(n.neighbor);
  line.at("distance_function").get_to(n.distance_function);
  line.at("distance").get_to(n.distance);
}

Json to_line(const StoredAlignment& a) {
  const Rows44 rows = a.X_target_model;
  return {
      {"model", a.model}, {"target", a.target}, {"method", a.method}, {"matrix", numbers({rows.data(), 16})}};
}

void from_line(const Json& line, StoredAlignment& a) {
  line.at("model").get_to(a.model);
  line.at("target").get_to(a.target);
  line.at("method").get_to(a.method);
  Rows44 rows;
  read_numbers(line.at("matrix"), {rows.data(), 16});
  a.X_target_model = rows;
}

Json to_line(const StoredGrasp& stored) {
  const Grasp& g = stored.grasp;
  Json contacts = Json::array();
  for (const GraspContact& c : g.contacts) contacts.push_back(contact_json(c));
  return {{"source", stored.source},
          {"epsilon", g.epsilon},
          {"volume", g.volume},
          {"energy", g.energy},
          {"form_closure", g.form_closure},
          {"max_penetration", g.max_penetration},
          {"planner", g.provenance.planner},
          {"seed", g.provenance.seed},
          {"options_digest", g.provenance.options_digest},
          {"version", g.provenance.version},
          {"amplitudes", numbers({g.amplitudes.data(), static_cast<std::size_t>(g.amplitudes.size())})},
          {"pregrasp", state_json(g.X_OH_pregrasp, g.pregrasp_joints, g.pregrasp_dofs)},
          {"grasp", state_json(g.X_OH, g.grasp_joints, g.grasp_dofs)},
          {"contacts", contacts}};
}

void from_line(const Json& line, StoredGrasp& stored) {
  line.at("source").get_to(stored.source);
  Grasp& g = stored.grasp;
  line.at("epsilon").get_to(g.epsilon);
  line.at("volume").get_to(g.volume);
  line.at("energy").get_to(g.energy);
  line.at("form_closure").get_to(g.form_closure);
  line.at("max_penetration").get_to(g.max_penetration);
  line.at("planner").get_to(g.provenance.planner);
  line.at("seed").get_to(g.provenance.seed);
  line.at("options_digest").get_to(g.provenance.options_digest);
  line.at("version").get_to(g.provenance.version);
  g.amplitudes = read_vector(line.at("amplitudes"));
  read_state(line.at("pregrasp"), g.X_OH_pregrasp, g.pregrasp_joints, g.pregrasp_dofs);
  read_state(line.at("grasp"), g.X_OH, g.grasp_joints, g.grasp_dofs);
  for (const Json& contact : line.at("contacts")) g.contacts.push_back(read_contact(contact));
}

}  // namespace eigengrasp
