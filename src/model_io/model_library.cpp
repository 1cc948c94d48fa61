// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/model_library.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "eigengrasp/core/error.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> data_folders() {
  if (const char* folder = std::getenv("EIGENGRASP_DATA_DIR"); folder && *folder) return {folder};
  std::vector<fs::path> folders;
  std::error_code ec;
  const fs::path program = fs::read_symlink("/proc/self/exe", ec);
  if (!ec) folders.push_back(program.parent_path().parent_path() / "share" / "eigengrasp");
  folders.emplace_back(EIGENGRASP_INSTALLED_DATA);
  folders.emplace_back(EIGENGRASP_SOURCE_DATA);
  return folders;
}

std::vector<fs::path> hand_folders() {
  std::vector<fs::path> folders;
  if (const char* list = std::getenv("EIGENGRASP_HANDS")) {
    const std::string all = list;
    for (std::size_t start = 0; start <= all.size();) {
      const std::size_t end = std::min(all.find(':', start), all.size());
      if (end > start) folders.emplace_back(all.substr(start, end - start));
      start = end + 1;
    }
  }
  for (const fs::path& data : data_folders()) folders.push_back(data / "hands");
  return folders;
}

bool is_hand_folder(const fs::path& folder) {
  std::error_code ec;
  return fs::is_regular_file(folder / "hand.yaml", ec);
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec)) {
    entries.push_back(it->path());
  }
  return entries;
}

std::vector<NamedModel> as_list(const std::map<std::string, fs::path>& models) {
  std::vector<NamedModel> list;
  for (const auto& [name, path] : models) list.push_back({name, path});
  return list;
}

std::vector<std::string> names_of(const std::vector<NamedModel>& models) {
  std::vector<std::string> names;
  for (const NamedModel& model : models) names.push_back(model.name);
  return names;
}

fs::path find_named(const std::string& name, const std::vector<NamedModel>& known, const char* kind,
                    const char* path_kind) {
  for (const NamedModel& model : known)
    if (model.name == name) return model.path;
  const auto names = names_of(known);
  fail("\"{}\" is no {} and no {}, expected one of {}{}", shown(name), path_kind, kind,
       names.empty() ? "(none is installed)" : join(names), did_you_mean(name, names));
}

}  // namespace

std::vector<NamedModel> list_hands() {
  std::map<std::string, fs::path> hands;
  for (const fs::path& folder : hand_folders()) {
    if (is_hand_folder(folder)) hands.emplace(fs::absolute(folder).lexically_normal().filename(), folder);
    for (const fs::path& entry : entries_of(folder))
      if (is_hand_folder(entry)) hands.emplace(entry.filename(), entry);
  }
  return as_list(hands);
}

std::vector<NamedModel> list_objects() {
  std::map<std::string, fs::path> objects;
  for (const fs::path& data : data_folders())
    for (const fs::path& entry : entries_of(data / "objects"))
      if (entry.extension() == ".obj") objects.emplace(entry.stem(), entry);
  return as_list(objects);
}

fs::path find_hand(const std::string& name_or_path) {
  std::error_code ec;
  if (fs::is_regular_file(name_or_path, ec) || is_hand_folder(name_or_path)) return name_or_path;
  return find_named(name_or_path, list_hands(), "known hand", "file or folder with hand.yaml");
}

fs::path find_object(const std::string& name_or_path) {
  std::error_code ec;
  if (fs::is_regular_file(name_or_path, ec)) return name_or_path;
  return find_library_object(name_or_path);
}

fs::path find_library_object(const std::string& name) {
  return find_named(name, list_objects(), "known object", "file");
}

fs::path find_shipped_grasps() {
  std::error_code ec;
  std::vector<std::string> places;
  for (const fs::path& data : data_folders()) {
    const fs::path file = data / "grasps" / "shipped.db";
    if (fs::is_regular_file(file, ec)) return fs::absolute(file).lexically_normal();
    places.push_back(file.string());
  }
  fail("the shipped grasps were not found, expected one of {}; install the data or name another store",
       join(places));
}

}  // namespace eigengrasp
