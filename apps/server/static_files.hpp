// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "server/http_types.hpp"

namespace eigengrasp::server {

/// The built web app, read whole at start: a path is looked up among those that were found then and never
/// reaches the file system.
class StaticFiles {
 public:
  /// Where there is no app: "/" then says how to build it.
  StaticFiles() = default;
  /// Takes the regular files below the folder; links are passed over.
  /// @throws Error where the folder has no index.html, or holds more than 256 MB.
  explicit StaticFiles(const std::filesystem::path& folder);

  bool empty() const { return files_.empty(); }
  HttpReply reply(const std::string& path) const;

 private:
  struct File {
    std::string content_type;
    std::string content;
  };
  std::map<std::string, File> files_;  ///< by path, such as /assets/app.js
};

/// Folder of the built web app: that beside the program's data where it is installed, else viewer/dist of the
/// source tree; empty where there is none.
std::filesystem::path find_app_folder();

}  // namespace eigengrasp::server
