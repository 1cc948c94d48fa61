// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cmath>

#include "cli/commands.hpp"
#include "cli/json_lines.hpp"
#include "cli/plan_options_cli.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/finger_closing.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"

namespace eigengrasp::cli {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct EvaluateChoice {
  std::filesystem::path states;
  SceneChoice scene;
  PlannerChoice planner;
  bool close = false;
  bool exact = false;
};

/// A pose that someone else made.
struct GivenState {
  Pose X_OH = Pose::Identity();
  VecX joints;  ///< (n_joints)
  VecX dofs;    ///< (n_dof)
};

/// Joint values by name; joints that are not named follow their degree of freedom's rest value.
VecX named_joint_values(const HandModel& hand, const json& named, const JsonLine& line) {
  VecX values = joint_values(hand, hand.rest_posture());
  for (const auto& [name, value] : named.items()) {
    const int j = hand.find_joint(name);
    if (j < 0) line.fail_because(fmt::format("joints names '{}', which {} does not have", name, hand.name));
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      line.fail_because(fmt::format("joints.{} is {}, expected a finite number", name, value.dump()));
    values[j] = value.get<double>();
  }
  return values;
}

GivenState parse_state(const HandModel& hand, const JsonLine& line) {
  GivenState s;
  s.X_OH = parse_pose(line, "hand_pose");
  if (line.member("joints").is_object()) {
    s.joints = named_joint_values(hand, line.member("joints"), line);
    s.dofs = posture_of_joints(hand, s.joints);
  } else if (!line.member("dofs").is_null()) {
    s.dofs = line.numbers("dofs", hand.n_dof());
    s.joints = joint_values(hand, s.dofs);
  } else {
    line.fail_because(
        fmt::format("has neither dofs ({} numbers) nor joints (an object of named values)", hand.n_dof()));
  }
  return s;
}

ordered_json numbers_json(const VecX& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

ordered_json contact_json(const GraspContact& c) {
  const ContactPoint& p = c.point;
  return {{"position", {p.p_OC.x(), p.p_OC.y(), p.p_OC.z()}},
          {"normal", {p.n_OC.x(), p.n_OC.y(), p.n_OC.z()}},
          {"mu", p.mu},
          {"torsion_length", p.torsion_length},
          {"link", c.link},
          {"patch", c.patch}};
}

ordered_json closed_json(const CollisionModel& model, const GraspEnergy& energy, const GivenState& state) {
  const HandModel& hand = *model.scene().hand;
  const ClosedHand closed = close_fingers(model, state.X_OH, state.dofs);
  ordered_json out;
  out["started_in_collision"] = closed.started_in_collision;
  out["dofs"] = numbers_json(closed.dofs);
  for (int j = 0; j < hand.n_joints(); ++j)
    if (const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)]; joint.type != JointType::fixed)
      out["joints"][joint.name] = closed.joints[j];
  out["contacts"] = ordered_json::array();
  const std::vector<GraspContact> contacts = find_contacts(model, closed.X_OL, {}, &closed.proximity);
  for (const GraspContact& c : contacts) out["contacts"].push_back(contact_json(c));
  const std::vector<ContactPoint> points = contact_points(contacts);
  const WrenchSpaceQuality quality = compute_epsilon(points, energy.wrench_space());
  out["form_closure"] = quality.form_closure;
  out["epsilon"] = quality.epsilon;
  out["volume"] = quality.form_closure ? compute_volume(points, energy.wrench_space()) : 0.0;
  out["max_penetration"] = model.deepest_penetration(closed.X_OL);
  return out;
}

/// The first joint beyond its limits as a sentence's middle; empty where there is none.
std::string limit_violation(const HandModel& hand, const GivenState& state) {
  constexpr double rounding = 1e-6;  // [rad or m]
  for (int j = 0; j < hand.n_joints(); ++j) {
    const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)];
    const double value = state.joints[j];
    if (joint.type != JointType::fixed && (value < joint.min - rounding || value > joint.max + rounding))
      return fmt::format("has the joint {} at {:.4f}, beyond its limits {:.4f} to {:.4f}", joint.name, value,
                         joint.min, joint.max);
  }
  return {};
}

ordered_json evaluate(const CollisionModel& model, const GraspEnergy& energy, const GivenState& state,
                      const EvaluateChoice& choice) {
  std::vector<Pose> X_OL;
  compute_link_poses(*model.scene().hand, state.joints, state.X_OH, X_OL);
  const Legality legality = choice.exact ? model.check_exact(X_OL) : model.check_fast(X_OL);
  ordered_json out;
  const std::string beyond = limit_violation(*model.scene().hand, state);
  out["legal"] = legality == Legality::legal && beyond.empty();
  out["reason"] = beyond.empty() ? describe(legality) : beyond;
  std::vector<ContactApproach> approaches;
  energy.approach(X_OL, choice.exact ? DistanceSource::exact : DistanceSource::field, approaches);
  out["contact_energy"] = energy.contact_energy(approaches);
  out["quality"] = energy.paper_quality(approaches);
  out["wrench_energy"] = energy.wrench_energy(approaches);
  out["deepest_penetration"] = model.deepest_penetration(X_OL);
  if (choice.close) out["closed"] = closed_json(model, energy, state);
  return out;
}

/// States of a file of our own grasps: the pre-grasp, or with --close the state that is closed again.
std::vector<JsonLine> lines_of_grasp_file(const std::filesystem::path& file, const json& document) {
  std::vector<JsonLine> lines;
  int rank = 0;
  for (const json& grasp : document.at("grasps")) {
    const json& pre = grasp.contains("pregrasp") ? grasp["pregrasp"] : grasp;
    lines.push_back({pre, fmt::format("{}: grasp {}", file.string(), ++rank)});
    if (!pre.is_object()) lines.back().fail_because("is no JSON object, expected a grasp");
  }
  return lines;
}

std::vector<JsonLine> lines_of(const std::filesystem::path& file) {
  const json document = parse_json(read_text_file(file));
  const bool grasp_file = document.is_object() && document.contains("grasps") &&
                          document.contains("format") && document["format"] == "eigengrasp-grasps";
  return grasp_file ? lines_of_grasp_file(file, document) : read_json_lines(file);
}

void run_evaluate(const EvaluateChoice& choice) {
  const Scene scene = load_scene(choice.scene);
  const PlanOptions plan = understand(choice.planner, *scene.hand);
  require_sound(plan, *scene.hand);
  std::vector<GivenState> states;  // all of them before the first is rated: bad input prints nothing
  for (const JsonLine& line : lines_of(choice.states)) states.push_back(parse_state(*scene.hand, line));
  CollisionModel::Options options;
  options.fast = !choice.exact || choice.close;  // fingers close as they do in plan, with the fields
  options.threads = choice.planner.options.threads;
  options.cache = plan.cache;
  const CollisionModel model(scene, options);
  const GraspEnergy energy(model, plan);
  for (const GivenState& state : states) print_line(evaluate(model, energy, state, choice));
}

}  // namespace

void add_evaluate_command(CLI::App& app) {
  auto choice = std::make_shared<EvaluateChoice>();
  CLI::App* command = app.add_subcommand("evaluate", "Rate hand states that someone else made");
  command
      ->add_option("states", choice->states,
                   "One JSON object a line: {\"hand_pose\": {\"position\": [m], \"orientation\": [w,x,y,z]}, "
                   "\"dofs\": [rad]} "
                   "or \"joints\": {name: rad}; or a grasps.json")
      ->required();
  command->add_option("--object", choice->scene.object,
                      "Mesh file, GraspIt! body, or a shipped object's name");
  add_scene_options(*command, choice->scene);
  add_wrench_options(*command, choice->planner);
  command->add_option("--alpha", choice->planner.options.alpha, "Length scale of eq. (6) [m]");
  command->add_option("--threads", choice->planner.options.threads, "0: all");
  command->add_flag("--close", choice->close, "Close the fingers as well and rate the grasp");
  command->add_flag("--exact", choice->exact, "Exact meshes instead of the distance field and inner spheres");
  command->footer(
      "Prints one JSON object a line, in the same order.\n"
      "Example:\n  eigengrasp evaluate states.jsonl --hand human --object glass --close --exact");
  command->callback([choice] { run_evaluate(*choice); });
}

}  // namespace eigengrasp::cli
