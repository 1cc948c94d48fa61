// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>

#include "model_io/file_bounds.hpp"
#include "model_io/hand_yaml.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> known_keys = {"format",           "version", "name",        "title",
                                             "based_on",         "urdf",    "approach",    "materials",
                                             "link_materials",   "dofs",    "eigengrasps", "virtual_contacts",
                                             "ignore_collisions"};

void check_version(const YamlValue& root) {
  const YamlValue format = root.require("format");
  if (format.text() != "eigengrasp-hand") {
    format.fail("format is \"{}\", expected eigengrasp-hand", format.written());
  }
  const YamlValue version = root.require("version");
  if (version.text() != "1") {
    version.fail("version is \"{}\", expected 1, the only one that this program reads", version.written());
  }
}

void read_into(HandDocument& document, const fs::path& file, const fs::path& only_within,
               std::vector<fs::path>& readers) {
  std::error_code ec;
  const fs::path canonical = fs::weakly_canonical(file, ec);
  readers.push_back(canonical);
  const YamlValue root = YamlValue::load(file);
  const auto fields = root.fields(known_keys);
  check_version(root);
  if (const auto base = root.find("based_on")) {
    fs::path base_file = file.parent_path() / base->text();
    if (!is_within(base_file, only_within)) {
      base->fail("based_on is \"{}\", which lies outside of the hand's folder, expected a hand in it",
                 base->written());
    }
    if (fs::is_directory(base_file, ec)) base_file /= "hand.yaml";
    if (!fs::is_regular_file(base_file, ec)) {
      base->fail("based_on is \"{}\", but {} does not exist", base->written(), base_file.string());
    }
    const fs::path next = fs::weakly_canonical(base_file, ec);
    if (std::find(readers.begin(), readers.end(), next) != readers.end()) {
      base->fail("based_on is \"{}\", which is based on this file itself, expected another hand",
                 base->written());
    }
    read_into(document, base_file, only_within, readers);
  }
  for (const auto& [key, value] : fields) document.keys.insert_or_assign(key, value);
}

}  // namespace

const YamlValue* HandDocument::find(const std::string& key) const {
  const auto found = keys.find(key);
  return found == keys.end() ? nullptr : &found->second;
}

const YamlValue& HandDocument::require(const std::string& key) const {
  const YamlValue* value = find(key);
  if (!value) fail_at(file, 0, "has no key \"{}\", expected one", key);
  return *value;
}

HandDocument read_hand_document(const fs::path& file, const fs::path& only_within) {
  HandDocument document;
  document.file = file;
  std::vector<fs::path> readers;
  read_into(document, file, only_within, readers);
  return document;
}

}  // namespace eigengrasp
