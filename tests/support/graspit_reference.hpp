// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/model_io/hand_io.hpp"
#include "support/test_data.hpp"

namespace eigengrasp::testing {

/// Folder of GraspIt!'s models in the test data; empty where it is absent.
inline std::filesystem::path graspit_models() {
  return test_data("graspit/models");
}

/// Loads a hand as the reference data names it: Barrett, DLR, Robonaut13 or Human, with the virtual contacts
/// and eigengrasps that were used there.
inline HandModel load_reference_hand(const std::string& name, HandReadOptions options = {}) {
  const auto robots = graspit_models() / "robots";
  const auto use_contacts = [&](const std::string& folder, const std::vector<std::string>& files) {
    for (const std::string& file : files)
      options.graspit_contact_files.push_back(robots / folder / "virtual" / (file + ".xml"));
  };
  if (name == "Barrett") return load_hand(robots / "Barrett/Barrett.xml", options);
  if (name == "DLR") {
    use_contacts("DLR", {"palm", "phlx_prox", "phlx_middle", "phlx_distal"});
    return load_hand(robots / "DLR/DLR.xml", options);
  }
  if (name == "Robonaut13") {
    use_contacts("Robonaut", {"palm", "proximal_phlx", "middle_phlx", "distal_phlx"});
    return load_hand(robots / "Robonaut/Robonaut_13DOF.xml", options);
  }
  options.graspit_eigengrasp_file = robots / "HumanHand/eigen/human_eigen.xml";
  return load_hand(robots / "HumanHand/HumanHand20DOF.xml", options);
}

}  // namespace eigengrasp::testing
