// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/model_io/hand_io.hpp"

namespace eigengrasp {

/// The hands and objects of the paper's experiments, in the order of its tables.
enum class PaperHand { barrett, dlr, robonaut, human };
enum class PaperObject { ashtray, shoe, glass, flask, phone, plane };
inline constexpr std::array kPaperHands{PaperHand::barrett, PaperHand::dlr, PaperHand::robonaut,
                                        PaperHand::human};
inline constexpr std::array kPaperObjects{PaperObject::ashtray, PaperObject::shoe,  PaperObject::glass,
                                          PaperObject::flask,   PaperObject::phone, PaperObject::plane};

/// "barrett", "dlr", "robonaut", "human".
const char* name_of(PaperHand hand);
const char* name_of(PaperObject object);
/// @throws Error that lists the names.
PaperHand parse_paper_hand(const std::string& name);
PaperObject parse_paper_object(const std::string& name);

/// Where the hands and objects come from.
struct ModelSource {
  /// GraspIt!'s folder of models; empty: the hands and objects that come with this program, which are alike
  /// in kinematics and size, not in shape. The Barrett hand is then barrett-metal.
  std::filesystem::path graspit;

  bool shipped() const { return graspit.empty(); }
};

/// GraspIt!'s models: the folder itself or its subfolder models. @throws Error where neither holds the
/// robots and objects of the paper.
ModelSource find_graspit_models(const std::filesystem::path& folder);

/// GraspIt!'s Barrett (19 virtual contacts), DLR (13), Robonaut with 13 degrees of freedom, to which its
/// contact files belong (15), HumanHand20DOF with human_eigen (18); or the shipped hand. The options' own
/// contact and eigengrasp files are replaced.
HandModel load_paper_hand(const ModelSource& source, PaperHand hand, HandReadOptions options = {});
/// GraspIt!'s ashtray, shoe_1741, glass, flask, phone, p51; or the shipped object.
ObjectModel load_paper_object(const ModelSource& source, PaperObject object);

}  // namespace eigengrasp
