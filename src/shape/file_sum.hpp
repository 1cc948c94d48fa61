// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <filesystem>

namespace eigengrasp {

/// FILE.sum beside a file of an index: its version, the numbers a descriptor has, and a hash of the file.
void write_file_sum(const std::filesystem::path& file, std::size_t dimension);

/// The dimension. @throws Error where a file is missing, FILE.sum is of another version, or FILE is not the
/// one that was written
std::size_t check_file_sum(const std::filesystem::path& file);

}  // namespace eigengrasp
