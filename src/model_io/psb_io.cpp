// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/psb_io.hpp"

#include <charconv>
#include <map>
#include <sstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp {

namespace {

namespace fs = std::filesystem;
/// What the classification says of a model.
struct Classified {
  std::vector<std::string> tags;
  bool test = false;
};
using ClassOfModel = std::map<int, Classified>;

/// The whole of a text as a number; -1 where it is none.
int as_number(std::string_view text) {
  int n = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() && n >= 0 ? n : -1;
}

/// The lines of a classification that are not empty.
class Lines {
 public:
  explicit Lines(const fs::path& file) : file_(file), text_(read_text_file(file)) {}

  bool next(std::string& line) {
    while (std::getline(text_, line)) {
      ++number_;
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      if (!line.empty()) return true;
    }
    return false;
  }
  [[noreturn]] void expected(const char* what, const std::string& found) const {
    fail_at(file_, number_, "found '{}', expected {}", found.substr(0, 60), what);
  }

 private:
  fs::path file_;
  std::istringstream text_;
  int number_ = 0;
};

struct ClassHead {
  std::string name, parent;
  int count = -1;
};

/// "NAME PARENT COUNT", where names may have blanks inside: the parent is a class that came before, or 0.
ClassHead parse_head(const Lines& lines, const std::string& line,
                     const std::map<std::string, std::vector<std::string>>& paths) {
  const auto last = line.rfind(' ');
  ClassHead head;
  head.count = last == std::string::npos ? -1 : as_number(line.substr(last + 1));
  if (head.count < 0) lines.expected("a class: its name, its parent's and its number of models", line);
  const std::string names = line.substr(0, last);
  for (auto blank = names.find(' '); blank != std::string::npos; blank = names.find(' ', blank + 1)) {
    head.name = names.substr(0, blank);
    head.parent = names.substr(blank + 1);
    if (head.parent == "0" || paths.contains(head.parent)) return head;
  }
  lines.expected("a class whose parent came before, or 0", line);
}

void read_classification(const fs::path& file, bool test, ClassOfModel& classes) {
  Lines lines(file);
  std::string line;
  if (!lines.next(line) || !line.starts_with("PSB ")) lines.expected("PSB and a version", line);
  if (!lines.next(line)) lines.expected("the numbers of classes and models", "the end of the file");
  std::map<std::string, std::vector<std::string>> paths;  // from the outermost class
  while (lines.next(line)) {
    const ClassHead head = parse_head(lines, line, paths);
    std::vector<std::string> path;
    if (head.parent != "0") path = paths.at(head.parent);
    path.push_back(head.name);
    for (int i = 0; i < head.count; ++i) {
      if (!lines.next(line)) lines.expected("the number of a model", "the end of the file");
      const int number = as_number(line);
      if (number < 0) lines.expected("the number of a model", line);
      classes[number] = {path, test};
    }
    paths[head.name] = path;
  }
}

/// Meshes by number: db/ANY/mNUMBER/mNUMBER.off.
std::map<int, fs::path> find_meshes(const fs::path& db) {
  std::map<int, fs::path> meshes;
  for (const auto& entry : fs::recursive_directory_iterator(db)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".off" || !stem.starts_with('m')) continue;
    if (const int number = as_number(stem.substr(1)); number >= 0) meshes[number] = entry.path();
  }
  return meshes;
}

}  // namespace

PsbLibrary load_psb(const fs::path& folder) {
  const fs::path root = fs::exists(folder / "benchmark" / "db") ? folder / "benchmark" : folder;
  const fs::path classes = root / "classification" / "v1" / "base";
  if (!fs::is_directory(root / "db") || !fs::exists(classes / "train.cla"))
    fail(
        "{}: is not the Princeton Shape Benchmark; expected the folder db and "
        "classification/v1/base/train.cla",
        folder.string());
  ClassOfModel known;
  read_classification(classes / "train.cla", false, known);
  if (fs::exists(classes / "test.cla")) read_classification(classes / "test.cla", true, known);
  std::map<int, fs::path> meshes = find_meshes(root / "db");
  PsbLibrary library;
  for (const auto& [number, classified] : known)
    if (!meshes.contains(number)) library.absent.push_back(number);
  for (const auto& [number, mesh] : meshes) {
    const auto found = known.find(number);
    const Classified classified = found == known.end() ? Classified{} : found->second;
    library.models.push_back({number, mesh, classified.tags, classified.test});
  }
  return library;
}

}  // namespace eigengrasp
