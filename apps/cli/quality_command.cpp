// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <cmath>

#include "cli/commands.hpp"
#include "cli/json_lines.hpp"
#include "cli/plan_options_cli.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"
#include "eigengrasp/quality/wrench_space.hpp"

namespace eigengrasp::cli {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct QualityChoice {
  std::filesystem::path contacts;
  PlannerChoice planner;
  std::vector<double> torque_origin;
};

ContactPoint parse_contact(const JsonLine& line) {
  ContactPoint c;
  c.p_OC = line.vector("position");
  c.n_OC = line.vector("normal");
  if (!(c.n_OC.norm() > 1e-9)) line.fail_because("normal is zero, expected a direction into the object");
  c.n_OC.normalize();
  if (line.member("mu").is_null())
    line.fail_because("mu is missing, expected a friction coefficient, 0 or more");
  c.mu = line.number("mu", 0.0);
  c.torsion_length = line.number("torsion_length", 0.0);
  if (c.mu < 0.0 || c.torsion_length < 0.0)
    line.fail_because(
        fmt::format("mu is {} and torsion_length {}, expected 0 or more", c.mu, c.torsion_length));
  return c;
}

std::vector<Vec6> parse_wrenches(const JsonLine& line) {
  std::vector<Vec6> wrenches;
  for (const json& w : line.member("wrenches"))
    wrenches.push_back(json_numbers(w, 6, line.where, "a wrench"));
  return wrenches;
}

/// Torque scale where none is given: the largest distance of a contact from the torque origin.
double contact_radius(const std::vector<ContactPoint>& contacts, const Vec3& origin) {
  double radius = 0.0;
  for (const ContactPoint& c : contacts) radius = std::max(radius, (c.p_OC - origin).norm());
  return radius > 0.0 ? radius : 1.0;
}

ordered_json result_json(const WrenchSpaceQuality& quality, double volume) {
  return {{"form_closure", quality.form_closure},
          {"epsilon", quality.epsilon},
          {"volume", quality.form_closure ? volume : 0.0}};
}

/// What one line asks for: either contacts or wrenches.
struct Question {
  std::vector<ContactPoint> contacts;
  std::vector<Vec6> wrenches;
  bool plain_wrenches = false;
  WrenchSpaceOptions options;
};

Question parse_question(const JsonLine& line, const WrenchSpaceOptions& given, bool scale_given) {
  Question q;
  q.options = given;
  if (line.member("wrenches").is_array()) {
    if (given.norm != WrenchNorm::l1)
      line.fail_because("has plain wrenches, whose space is their hull; expected contacts with --norm linf");
    q.wrenches = parse_wrenches(line);
    q.plain_wrenches = true;
    return q;
  }
  if (!line.member("contacts").is_array())
    line.fail_because("has neither contacts nor wrenches, expected an array of one of them");
  std::vector<ContactPoint>& contacts = q.contacts;
  WrenchSpaceOptions& options = q.options;
  for (const json& c : line.member("contacts")) {
    if (!c.is_object()) line.fail_because("contacts holds " + c.dump().substr(0, 60) + ", expected objects");
    contacts.push_back(parse_contact({c, fmt::format("{}: contact {}", line.where, contacts.size() + 1)}));
  }
  if (!line.member("torque_origin").is_null()) options.torque_origin_O = line.vector("torque_origin");
  options.torque_scale = line.number(
      "torque_scale", scale_given ? options.torque_scale : contact_radius(contacts, options.torque_origin_O));
  if (!(options.torque_scale > 0.0))
    line.fail_because(fmt::format("torque_scale is {}, expected more than 0", options.torque_scale));
  return q;
}

ordered_json rate(const Question& q) {
  if (q.plain_wrenches)
    return result_json(compute_epsilon(q.wrenches, q.options.epsilon_min), compute_hull_volume(q.wrenches));
  ordered_json out =
      result_json(compute_epsilon(q.contacts, q.options), compute_volume(q.contacts, q.options));
  out["torque_scale"] = q.options.torque_scale;
  return out;
}

void run_quality(const QualityChoice& choice) {
  const PlanOptions plan = understand(choice.planner, HandModel{});
  WrenchSpaceOptions options;
  options.norm = plan.norm;
  options.cone = plan.cone;
  options.edges = plan.cone_edges;
  options.epsilon_min = plan.epsilon_min;
  if (options.edges < 3 || options.edges > 1000) fail("--edges is {}, expected 3 to 1000", options.edges);
  if (!(options.epsilon_min >= 0.0)) fail("--epsilon-min is {}, expected 0 or more", options.epsilon_min);
  if (!(plan.torque_scale >= 0.0) || !std::isfinite(plan.torque_scale))
    fail("--torque-scale is {}, expected more than 0", plan.torque_scale);
  if (plan.torque_scale > 0.0) options.torque_scale = plan.torque_scale;
  if (choice.torque_origin.size() == 3) options.torque_origin_O = Vec3(choice.torque_origin.data());
  std::vector<Question> questions;  // all of them before the first is answered: bad input prints nothing
  for (const JsonLine& line : read_json_lines(choice.contacts))
    questions.push_back(parse_question(line, options, plan.torque_scale > 0.0));
  for (const Question& q : questions) print_line(rate(q));
}

}  // namespace

void add_quality_command(CLI::App& app) {
  auto choice = std::make_shared<QualityChoice>();
  CLI::App* command =
      app.add_subcommand("quality", "Epsilon, volume and form closure of given contacts, without a hand");
  command
      ->add_option("contacts", choice->contacts,
                   "One JSON object a line: {\"contacts\": [{\"position\": [m], \"normal\": [into the "
                   "object], \"mu\": 0.5, "
                   "\"torsion_length\": [m]}], \"torque_origin\": [m], \"torque_scale\": [m]} or "
                   "{\"wrenches\": [[6 numbers]]}")
      ->required();
  add_wrench_options(*command, choice->planner);
  command
      ->add_option("--torque-origin", choice->torque_origin,
                   "Point that torques are about [m] (default: 0 0 0)")
      ->expected(3);
  command->footer(
      "Without a torque scale the largest distance of a contact from the torque origin is taken, and "
      "printed.\n"
      "Example:\n  eigengrasp quality contacts.jsonl --true-cone --torque-scale 0.06");
  command->callback([choice] { run_quality(*choice); });
}

}  // namespace eigengrasp::cli
