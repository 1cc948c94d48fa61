// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/static_files.hpp"

#include <cstdlib>
#include <fstream>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp::server {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{256} << 20;

std::string content_type_of(const fs::path& file) {
  static const std::map<std::string, std::string> types = {{".html", "text/html; charset=utf-8"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".css", "text/css; charset=utf-8"},
                                                           {".json", "application/json"},
                                                           {".svg", "image/svg+xml"},
                                                           {".png", "image/png"},
                                                           {".ico", "image/x-icon"},
                                                           {".wasm", "application/wasm"},
                                                           {".woff2", "font/woff2"},
                                                           {".map", "application/json"},
                                                           {".glb", "model/gltf-binary"},
                                                           {".txt", "text/plain; charset=utf-8"}};
  const auto found = types.find(file.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

constexpr const char* kNoApp =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>eigengrasp</title>"
    "<p>The server runs, but the web app is not built. Build it with <code>./run serve</code>, or with "
    "<code>npm ci &amp;&amp; npm run build</code> in the folder <code>viewer</code>, and start the server "
    "again; "
    "or name the folder of a built app with <code>--app</code>.</p></html>\n";

}  // namespace

StaticFiles::StaticFiles(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / "index.html", error))
    fail("{}: has no index.html, expected the folder of the built web app; build it with './run serve'",
         folder.string());
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_symlink() || !entry.is_regular_file()) continue;
    bytes += entry.file_size();
    if (bytes > kMostBytes) fail("{}: holds more than 256 MB, expected a built web app", folder.string());
    const std::string path = fmt::format("/{}", fs::relative(entry.path(), folder).generic_string());
    files_[path] = {content_type_of(entry.path()), read_text_file(entry.path())};
  }
}

HttpReply StaticFiles::reply(const std::string& path) const {
  if (files_.empty() && path == "/") return {200, "text/html; charset=utf-8", kNoApp, ""};
  const auto found = files_.find(path == "/" ? "/index.html" : path);
  if (found == files_.end()) return refusal(404, "there is nothing at this path; the app is at /");
  return {200, found->second.content_type, found->second.content, ""};
}

fs::path find_app_folder() {
  std::vector<fs::path> places;
  std::error_code error;
  if (const char* data = std::getenv("EIGENGRASP_DATA_DIR")) places.push_back(fs::path(data) / "viewer");
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) places.push_back(program.parent_path().parent_path() / "share" / "eigengrasp" / "viewer");
  places.emplace_back(EIGENGRASP_INSTALLED_APP);
  places.emplace_back(EIGENGRASP_SOURCE_APP);
  for (const fs::path& place : places)
    if (fs::is_regular_file(place / "index.html", error)) return place;
  return {};
}

}  // namespace eigengrasp::server
