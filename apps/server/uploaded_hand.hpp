// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/kinematics/hand_model.hpp"
#include "server/server_options.hpp"

namespace eigengrasp::server {

struct UploadedHand {
  std::shared_ptr<HandModel> model;   ///< its name is sound; nothing of it is on the disk any more
  std::vector<std::string> warnings;  ///< what `eigengrasp hand check` says, worst first
};

/// Reads the archive of a hand's folder (docs/hand-format.md) that a client sent. It is unpacked into a
/// folder of its own, which is gone afterwards; hand.yaml and URDF name no files outside of it.
/// @throws Error, one sentence, which does not name that folder.
UploadedHand read_uploaded_hand(const std::string& file_name, const std::string& bytes,
                                const ServerLimits& limits);

}  // namespace eigengrasp::server
