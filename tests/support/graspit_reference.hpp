// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/model_io/paper_models.hpp"
#include "support/test_data.hpp"

namespace eigengrasp::testing {

/// Folder of GraspIt!'s models in the test data; empty where it is absent.
inline std::filesystem::path graspit_models() {
  return test_data("graspit/models");
}

/// Loads a hand as the reference data names it: Barrett, DLR, Robonaut13 or Human, with the virtual contacts
/// and eigengrasps that were used there.
inline HandModel load_reference_hand(const std::string& name, const HandReadOptions& options = {}) {
  const PaperHand hand = name == "Barrett"      ? PaperHand::barrett
                         : name == "DLR"        ? PaperHand::dlr
                         : name == "Robonaut13" ? PaperHand::robonaut
                                                : PaperHand::human;
  return load_paper_hand({graspit_models()}, hand, options);
}

}  // namespace eigengrasp::testing
