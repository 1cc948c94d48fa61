// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/paper_models.hpp"

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

constexpr std::array hand_names{"barrett", "dlr", "robonaut", "human"};
constexpr std::array object_names{"ashtray", "shoe", "glass", "flask", "phone", "plane"};
constexpr std::array shipped_hands{"barrett-metal", "dlr", "robonaut", "human"};
constexpr std::array graspit_hands{"Barrett/Barrett.xml", "DLR/DLR.xml", "Robonaut/Robonaut_13DOF.xml",
                                   "HumanHand/HumanHand20DOF.xml"};
constexpr std::array graspit_objects{"ashtray", "shoe_1741", "glass", "flask", "phone", "p51"};

template <typename Names, typename Enum>
const char* at(const Names& names, Enum value) {
  return names.at(static_cast<std::size_t>(value));
}

template <typename Enum, typename Names>
Enum parse_name(const std::string& text, const Names& names, const char* kind) {
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (text == names[i]) return static_cast<Enum>(i);
    known += (i ? ", " : "") + std::string(names[i]);
  }
  fail("'{}' is no {} of the paper, expected one of {}", text, kind, known);
}

/// A path of the models folder that is missing; empty: none.
fs::path first_missing(const fs::path& models) {
  std::vector<fs::path> needed;
  for (const char* hand : graspit_hands) needed.push_back(fs::path("robots") / hand);
  for (const char* object : graspit_objects)
    needed.push_back(fs::path("objects") / (object + std::string(".xml")));
  for (const fs::path& file : needed)
    if (std::error_code ec; !fs::is_regular_file(models / file, ec)) return file;
  return {};
}

}  // namespace

const char* name_of(PaperHand hand) {
  return at(hand_names, hand);
}

const char* name_of(PaperObject object) {
  return at(object_names, object);
}

PaperHand parse_paper_hand(const std::string& name) {
  return parse_name<PaperHand>(name, hand_names, "hand");
}

PaperObject parse_paper_object(const std::string& name) {
  return parse_name<PaperObject>(name, object_names, "object");
}

ModelSource find_graspit_models(const fs::path& folder) {
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) fail("{}: is no folder, expected GraspIt!'s models", folder.string());
  const fs::path models = fs::is_directory(folder / "models", ec) ? folder / "models" : folder;
  if (const fs::path missing = first_missing(models); !missing.empty())
    fail("{}: holds no {}, expected GraspIt!'s folder of models", models.string(), missing.string());
  return {models};
}

HandModel load_paper_hand(const ModelSource& source, PaperHand hand, HandReadOptions options) {
  options.graspit_contact_files.clear();
  options.graspit_eigengrasp_file.clear();
  if (source.shipped()) return load_hand(find_hand(at(shipped_hands, hand)), options);
  const fs::path robots = source.graspit / "robots";
  const auto use_contacts = [&](const char* robot, std::initializer_list<const char*> files) {
    for (const char* file : files)
      options.graspit_contact_files.push_back(robots / robot / "virtual" / (file + std::string(".xml")));
  };
  if (hand == PaperHand::dlr) use_contacts("DLR", {"palm", "phlx_prox", "phlx_middle", "phlx_distal"});
  if (hand == PaperHand::robonaut)
    use_contacts("Robonaut", {"palm", "proximal_phlx", "middle_phlx", "distal_phlx"});
  if (hand == PaperHand::human) options.graspit_eigengrasp_file = robots / "HumanHand/eigen/human_eigen.xml";
  return load_hand(robots / at(graspit_hands, hand), options);
}

ObjectModel load_paper_object(const ModelSource& source, PaperObject object) {
  if (source.shipped()) return load_object(find_object(name_of(object)));
  return load_graspit_body(source.graspit / "objects" / (at(graspit_objects, object) + std::string(".xml")));
}

}  // namespace eigengrasp
