// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/hand_io.hpp"

#include "model_io/file_bounds.hpp"
#include "model_io/graspit_robot.hpp"
#include "model_io/hand_assembly.hpp"
#include "model_io/hand_yaml.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

HandModel load_yaml_hand(const fs::path& file, const HandReadOptions& options) {
  const HandDocument document = read_hand_document(file, options.only_within);
  const YamlValue& urdf_name = document.require("urdf");
  const fs::path urdf_file = urdf_name.file().parent_path() / urdf_name.text();
  if (!is_within(urdf_file, options.only_within)) {
    urdf_name.fail("urdf is \"{}\", which lies outside of the hand's folder, expected a file in it",
                   urdf_name.written());
  }
  std::error_code ec;
  if (!fs::is_regular_file(urdf_file, ec)) {
    urdf_name.fail("urdf is \"{}\", but {} does not exist", urdf_name.written(), urdf_file.string());
  }
  const Urdf urdf = read_urdf(urdf_file, options.only_within);
  HandModel hand = build_urdf_hand(urdf, options.load_meshes);
  hand.source = file;
  hand.name = document.require("name").text();
  if (const YamlValue* title = document.find("title")) hand.title = title->text();
  read_dofs(document, urdf, hand);
  clamp_rest(hand);
  read_materials(document, hand);
  read_approach(document, hand, options.log);
  read_eigengrasps(document, hand, options.log);
  read_virtual_contacts(document, hand);
  read_collision_pairs(document, hand);
  return hand;
}

HandModel load_bare_urdf(const fs::path& file, const HandReadOptions& options) {
  HandModel hand = build_urdf_hand(read_urdf(file, options.only_within), options.load_meshes);
  clamp_rest(hand);
  hand.eigengrasps = all_postures(hand);
  set_collision_pairs(hand, {});
  if (options.log) {
    options.log(
        fmt::format("{}: is a URDF without hand.yaml; the hand does not close, has no virtual contacts "
                    "and comes along the base's z axis",
                    file.string()));
  }
  return hand;
}

HandModel load_xml_hand(const fs::path& file, const HandReadOptions& options) {
  const XmlFile xml(file);
  if (xml.root().name() != "robot") {
    xml.root().fail("the outermost element is <{}>, expected <robot>, a hand of GraspIt!", xml.root().name());
  }
  return xml.root().child("palm") ? load_graspit_robot(file, options) : load_bare_urdf(file, options);
}

HandModel load_any(const fs::path& path, const HandReadOptions& options) {
  std::error_code ec;
  if (!fs::exists(path, ec))
    fail("{}: does not exist, expected a folder with hand.yaml, or a file", path.string());
  if (fs::is_directory(path, ec)) {
    if (!fs::is_regular_file(path / "hand.yaml", ec)) {
      fail("{}: holds no hand.yaml, expected one (or name the file of the hand itself)", path.string());
    }
    return load_yaml_hand(path / "hand.yaml", options);
  }
  const std::string ending = lower_extension(path.string());
  if (ending == ".yaml" || ending == ".yml") return load_yaml_hand(path, options);
  if (ending == ".xml") return load_xml_hand(path, options);
  if (ending == ".urdf") return load_bare_urdf(path, options);
  fail("{}: ends in \"{}\", expected a folder, or a file that ends in .yaml, .urdf or .xml", path.string(),
       ending);
}

}  // namespace

HandModel load_hand(const fs::path& path, const HandReadOptions& options) {
  HandModel hand = load_any(path, options);
  check_invariants(hand);
  return hand;
}

}  // namespace eigengrasp
