// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cstdint>
#include <limits>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/report/grasp_file.hpp"
#include "grasp_file_names.hpp"
#include "json_text.hpp"

namespace eigengrasp {

namespace {

constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
constexpr int kLargestInt = std::numeric_limits<int>::max();

int count_at(const JsonView& view, const char* key, int low = 0) {
  return static_cast<int>(view.at(key).integer(low, kLargestInt));
}

/// Refuses what is no grasp file, or one of a version that this program does not know.
void check_format(const JsonView& view) {
  const JsonView format = view.at("format");
  if (format.text() != "eigengrasp-grasps") format.refuse("\"eigengrasp-grasps\"");
  const JsonView version = view.at("version");
  if (version.integer(1, kLargest) > kGraspFileVersion)
    version.refuse(
        fmt::format("at most {}: the file was written by a newer eigengrasp, update this program to read it",
                    kGraspFileVersion));
}

SourceFile read_source(const JsonView& view) {
  return {view.at("path").text(), view.at("digest").text()};
}

HandRecord read_hand(const JsonView& view) {
  return {view.at("name").text(), read_source(view.at("source")), view.at("joints").texts(),
          view.at("dofs").texts()};
}

ObjectRecord read_object(const JsonView& view) {
  ObjectRecord object;
  object.name = view.at("name").text();
  object.source = read_source(view.at("source"));
  object.units = view.at("units").text();
  object.scale = view.at("scale").number();
  if (!(object.scale > 0.0)) view.at("scale").refuse("a number above 0");
  object.center_of_mass = view.at("center_of_mass").vec3();
  object.max_radius = view.at("max_radius").number_at_least(0.0);
  object.watertight = view.at("watertight").boolean();
  object.material.name = view.at("material").text();
  if (view.has("friction")) object.material.friction = view.at("friction").number_at_least(0.0);
  return object;
}

PlanOptions read_options(const JsonView& view) {
  PlanOptions options;
  options.iterations = view.at("iterations").integer(0, kLargest);
  options.time_limit = view.at("time_limit").number_at_least(0.0);
  options.grasps = count_at(view, "grasps");
  options.seed = view.at("seed").natural();
  options.chains = count_at(view, "chains");
  options.amplitudes = count_at(view, "amplitudes");
  options.energy = kEnergyNames.read(view.at("energy"));
  if (view.has("search")) options.search = kSearchNames.read(view.at("search"));
  options.alpha = view.at("alpha").number();
  options.norm = kNormNames.read(view.at("norm"));
  options.cone = kConeNames.read(view.at("cone"));
  options.cone_edges = count_at(view, "cone_edges");
  options.epsilon_min = view.at("epsilon_min").number();
  options.torque_scale = view.at("torque_scale").number_at_least(0.0);
  return options;
}

/// Values of every movable joint of the hand, each once.
NamedValues read_joints(const JsonView& view, const HandRecord& hand) {
  NamedValues joints;
  for (const auto& [name, value] : view.members()) {
    if (std::find(hand.joints.begin(), hand.joints.end(), name) == hand.joints.end())
      value.refuse("the name of one of hand.joints");
    joints.emplace_back(name, value.number());
  }
  if (joints.size() != hand.joints.size())
    view.refuse(fmt::format("an object with the {} joints of hand.joints", hand.joints.size()));
  return joints;
}

GraspContact read_contact(const JsonView& view) {
  GraspContact contact;
  contact.link = view.at("link").text();
  contact.patch = count_at(view, "patch");
  contact.point.p_OC = view.at("position").vec3();
  contact.point.n_OC = view.at("normal").unit_vec3();
  contact.point.mu = view.at("mu").number_at_least(0.0);
  contact.point.torsion_length = view.at("torsion_length").number_at_least(0.0);
  return contact;
}

Grasp read_grasp(const JsonView& view, const GraspFile& file) {
  const auto n_dof = static_cast<int>(file.hand.dofs.size());
  Grasp grasp;
  grasp.hand = file.hand.name;
  grasp.object = file.object.name;
  grasp.object_scale = file.object.scale;
  grasp.epsilon = view.at("epsilon").number_at_least(0.0);
  grasp.volume = view.at("volume").number_at_least(0.0);
  grasp.energy = view.at("energy").number();
  grasp.form_closure = view.at("form_closure").boolean();
  grasp.max_penetration = view.at("max_penetration").number();
  const JsonView pregrasp = view.at("pregrasp");
  grasp.X_OH_pregrasp = pregrasp.at("hand_pose").pose();
  grasp.pregrasp_joints = read_joints(pregrasp.at("joints"), file.hand);
  grasp.pregrasp_dofs = pregrasp.at("dofs").numbers(n_dof);
  grasp.amplitudes = pregrasp.at("amplitudes").numbers();
  const JsonView closed = view.at("grasp");
  grasp.X_OH = closed.at("hand_pose").pose();
  grasp.grasp_joints = read_joints(closed.at("joints"), file.hand);
  grasp.grasp_dofs = closed.at("dofs").numbers(n_dof);
  for (const JsonView& contact : view.at("contacts").elements())
    grasp.contacts.push_back(read_contact(contact));
  const JsonView provenance = view.at("provenance");
  grasp.provenance = {provenance.at("planner").text(), provenance.at("seed").natural(),
                      provenance.at("options_digest").text(), provenance.at("version").text()};
  return grasp;
}

void read_statistics(const JsonView& view, PlanResult& result) {
  const JsonView states = view.at("states");
  const auto states_at = [&](const char* key) { return states.at(key).integer(0, kLargest); };
  result.states = {states_at("evaluated"), states_at("legal"), states_at("hit_object"),
                   states_at("hit_itself"), states_at("hit_obstacle")};
  const JsonView candidates = view.at("candidates");
  const auto candidates_at = [&](const char* key) { return count_at(candidates, key); };
  result.candidates = {candidates_at("tested"), candidates_at("form_closed"), candidates_at("not_closed"),
                       candidates_at("no_contact"), candidates_at("penetrating")};
}

SearchMilestone read_milestone(const JsonView& view, int n_dof) {
  return {view.at("iteration").integer(0, kLargest), view.at("energy").number(), view.at("hand_pose").pose(),
          view.at("dofs").numbers(n_dof)};
}

void read_run(const JsonView& view, GraspFile& file) {
  file.options.threads = count_at(view, "threads");
  const JsonView timings = view.at("timings");
  const auto seconds_at = [&](const char* key) { return timings.at(key).number_at_least(0.0); };
  file.result.timings = {.prepare = seconds_at("prepare"),
                         .search = seconds_at("search"),
                         .close = seconds_at("close"),
                         .total = seconds_at("total")};
}

}  // namespace

GraspFile parse_grasps(std::string_view text, const std::string& name) {
  const OrderedJson json = parse_json(text, name);
  const JsonView view(json, name);
  check_format(view);
  GraspFile file;
  file.version = view.at("program_version").text();
  file.hand = read_hand(view.at("hand"));
  file.object = read_object(view.at("object"));
  for (const JsonView& obstacle : view.at("obstacles").elements())
    file.obstacles.push_back(
        {obstacle.at("name").text(), read_source(obstacle.at("source")), obstacle.at("pose").pose()});
  file.options = read_options(view.at("options"));
  PlanResult& result = file.result;
  result.status = kStatusNames.read(view.at("status"));
  result.stopped_early = view.at("stopped_early").boolean();
  result.explanation = view.at("explanation").text();
  for (const JsonView& grasp : view.at("grasps").elements()) result.grasps.push_back(read_grasp(grasp, file));
  read_statistics(view.at("statistics"), result);
  for (const JsonView& milestone : view.at("milestones").elements())
    result.milestones.push_back(read_milestone(milestone, static_cast<int>(file.hand.dofs.size())));
  if (view.has("run")) read_run(view.at("run"), file);
  return file;
}

GraspFile load_grasps(const std::filesystem::path& path) {
  return parse_grasps(read_text_file(path), path.string());
}

std::string bytes_digest(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return fmt::format("fnv1a64:{:016x}", hash);
}

std::string file_digest(const std::filesystem::path& path) {
  return bytes_digest(read_text_file(path));
}

}  // namespace eigengrasp
