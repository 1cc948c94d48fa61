// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace eigengrasp {

/// The whole text of a file.
/// @throws Error where the file is missing, is a folder or cannot be read.
std::string read_text_file(const std::filesystem::path& file);

/// Writes beside the target and renames, so that the target is either the old file or the whole new one.
/// Makes missing parent folders.
/// @throws Error where the folder cannot be written or the disk is full; the target is then as it was.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// Makes sure that a folder exists and can be written to.
/// @throws Error otherwise.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace eigengrasp
