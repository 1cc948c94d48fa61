// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <stdexcept>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/version.hpp"
#include "eigengrasp/report/grasp_file.hpp"
#include "grasp_file_names.hpp"
#include "json_text.hpp"

namespace eigengrasp {

namespace {

OrderedJson conventions_json() {
  return {
      {"units", "metre, radian, newton, kilogram, second"},
      {"frames",
       "O is the object's frame: that of its mesh file, lengths times the metres of its units and its scale. "
       "H is the hand's base frame. hand_pose is the pose of H in O: p_O = R p_H + position."},
      {"orientation", "unit quaternion [w, x, y, z]"},
      {"joints", "by name: angle [rad] or displacement [m] of every movable joint"},
      {"dofs", "one number for each of hand.dofs, in that order"},
      {"contacts",
       "position and unit normal in O; the normal points into the object, along the force of the hand"},
      {"epsilon",
       "radius of the largest ball about the origin inside the wrench space, torques divided by "
       "torque_scale"},
  };
}

OrderedJson source_json(const SourceFile& source) {
  return {{"path", source.path}, {"digest", source.digest}};
}

OrderedJson object_json(const ObjectRecord& object) {
  OrderedJson json = {
      {"name", object.name},
      {"source", source_json(object.source)},
      {"units", object.units},
      {"scale", object.scale},
      {"center_of_mass", numbers_json(object.center_of_mass)},
      {"max_radius", object.max_radius},
      {"watertight", object.watertight},
      {"material", object.material.name},
  };
  if (object.material.friction) json["friction"] = *object.material.friction;
  return json;
}

OrderedJson options_json(const PlanOptions& options) {
  return {
      {"iterations", options.iterations},
      {"time_limit", options.time_limit},
      {"grasps", options.grasps},
      {"seed", options.seed},
      {"chains", options.chains},
      {"amplitudes", options.amplitudes},
      {"energy", kEnergyNames.name(options.energy)},
      {"search", kSearchNames.name(options.search)},
      {"alpha", options.alpha},
      {"norm", kNormNames.name(options.norm)},
      {"cone", kConeNames.name(options.cone)},
      {"cone_edges", options.cone_edges},
      {"epsilon_min", options.epsilon_min},
      {"torque_scale", options.torque_scale},
  };
}

OrderedJson joints_json(const NamedValues& joints) {
  OrderedJson json = OrderedJson::object();
  for (const auto& [name, value] : joints) json[name] = value;
  return json;
}

OrderedJson contact_json(const GraspContact& contact) {
  return {
      {"link", contact.link},
      {"patch", contact.patch},
      {"position", numbers_json(contact.point.p_OC)},
      {"normal", numbers_json(contact.point.n_OC)},
      {"mu", contact.point.mu},
      {"torsion_length", contact.point.torsion_length},
  };
}

OrderedJson grasp_json(const Grasp& grasp, int rank) {
  OrderedJson contacts = OrderedJson::array();
  for (const GraspContact& contact : grasp.contacts) contacts.push_back(contact_json(contact));
  return {
      {"rank", rank},
      {"epsilon", grasp.epsilon},
      {"volume", grasp.volume},
      {"energy", grasp.energy},
      {"form_closure", grasp.form_closure},
      {"max_penetration", grasp.max_penetration},
      {"pregrasp",
       {{"hand_pose", pose_json(grasp.X_OH_pregrasp)},
        {"joints", joints_json(grasp.pregrasp_joints)},
        {"dofs", numbers_json(grasp.pregrasp_dofs)},
        {"amplitudes", numbers_json(grasp.amplitudes)}}},
      {"grasp",
       {{"hand_pose", pose_json(grasp.X_OH)},
        {"joints", joints_json(grasp.grasp_joints)},
        {"dofs", numbers_json(grasp.grasp_dofs)}}},
      {"contacts", contacts},
      {"provenance",
       {{"planner", grasp.provenance.planner},
        {"seed", grasp.provenance.seed},
        {"options_digest", grasp.provenance.options_digest},
        {"version", grasp.provenance.version}}},
  };
}

OrderedJson statistics_json(const PlanResult& result) {
  const StateCounts& s = result.states;
  const CandidateCounts& c = result.candidates;
  return {
      {"states",
       {{"evaluated", s.evaluated},
        {"legal", s.legal},
        {"hit_object", s.hit_object},
        {"hit_itself", s.hit_itself},
        {"hit_obstacle", s.hit_obstacle}}},
      {"candidates",
       {{"tested", c.tested},
        {"form_closed", c.form_closed},
        {"not_closed", c.not_closed},
        {"no_contact", c.no_contact},
        {"penetrating", c.penetrating}}},
  };
}

OrderedJson milestones_json(const std::vector<SearchMilestone>& milestones) {
  OrderedJson json = OrderedJson::array();
  for (const SearchMilestone& m : milestones)
    json.push_back({{"iteration", m.iteration},
                    {"energy", m.energy},
                    {"hand_pose", pose_json(m.X_OH)},
                    {"dofs", numbers_json(m.dofs)}});
  return json;
}

OrderedJson run_json(const GraspFile& file) {
  const PlanTimings& t = file.result.timings;
  return {
      {"threads", file.options.threads},
      {"timings", {{"prepare", t.prepare}, {"search", t.search}, {"close", t.close}, {"total", t.total}}}};
}

SourceFile source_file(const std::filesystem::path& path) {
  SourceFile source{path.string(), ""};
  std::error_code ec;
  if (std::filesystem::is_regular_file(path, ec)) source.digest = file_digest(path);
  return source;
}

}  // namespace

GraspFile make_grasp_file(const Scene& scene, const ObjectUnits& units, const PlanOptions& options,
                          PlanResult result) {
  if (!scene.hand || !scene.object) throw std::logic_error("make_grasp_file: a scene without hand or object");
  GraspFile file;
  file.hand = {scene.hand->name, source_file(scene.hand->source), {}, scene.hand->dof_names()};
  for (const HandJoint& joint : scene.hand->joints)
    if (joint.type != JointType::fixed) file.hand.joints.push_back(joint.name);
  const ObjectModel& object = *scene.object;
  file.object = {object.name,           source_file(object.source), units.units,       units.scale,
                 object.center_of_mass, object.max_radius,          object.watertight, scene.object_material};
  for (const Obstacle& obstacle : scene.obstacles)
    file.obstacles.push_back({obstacle.model->name, source_file(obstacle.model->source), obstacle.X_OB});
  file.options = options;
  file.options.stop = nullptr;
  file.options.progress = nullptr;
  file.result = std::move(result);
  file.version = version();
  return file;
}

std::string grasps_json(const GraspFile& file, RunPart run) {
  OrderedJson obstacles = OrderedJson::array();
  for (const ObstacleRecord& obstacle : file.obstacles)
    obstacles.push_back({{"name", obstacle.name},
                         {"source", source_json(obstacle.source)},
                         {"pose", pose_json(obstacle.X_OB)}});
  OrderedJson grasps = OrderedJson::array();
  int rank = 0;
  for (const Grasp& grasp : file.result.grasps) grasps.push_back(grasp_json(grasp, ++rank));
  OrderedJson json = {
      {"format", "eigengrasp-grasps"},
      {"version", kGraspFileVersion},
      {"program_version", file.version},
      {"conventions", conventions_json()},
      {"hand",
       {{"name", file.hand.name},
        {"source", source_json(file.hand.source)},
        {"joints", file.hand.joints},
        {"dofs", file.hand.dofs}}},
      {"object", object_json(file.object)},
      {"obstacles", obstacles},
      {"options", options_json(file.options)},
      {"status", kStatusNames.name(file.result.status)},
      {"stopped_early", file.result.stopped_early},
      {"explanation", file.result.explanation},
      {"grasps", grasps},
      {"statistics", statistics_json(file.result)},
      {"milestones", milestones_json(file.result.milestones)},
  };
  if (run == RunPart::with) json["run"] = run_json(file);
  return pretty_text(json);
}

void save_grasps(const GraspFile& file, const std::filesystem::path& path) {
  write_file_atomically(path, grasps_json(file));
}

}  // namespace eigengrasp
