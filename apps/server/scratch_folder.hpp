// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/core/temporary_folder.hpp"

namespace eigengrasp::server {

/// A folder of an upload, which goes with everything in it.
class ScratchFolder : public TemporaryFolder {
 public:
  ScratchFolder() : TemporaryFolder("upload") {}

  /// A sentence as the client may read it: files are named as it named them, the folder is not.
  std::string hidden_in(std::string sentence) const;
};

}  // namespace eigengrasp::server
