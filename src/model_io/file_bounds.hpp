// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>

namespace eigengrasp {

/// Whether a file lies in a folder, links followed. True for all files where no folder is given.
bool is_within(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace eigengrasp
