// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/uploaded_hand.hpp"

#include <algorithm>
#include <filesystem>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/model_io/hand_check.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "server/archive.hpp"
#include "server/scratch_folder.hpp"
#include "server/upload_name.hpp"
#include "server/uploaded_mesh.hpp"

namespace eigengrasp::server {

namespace fs = std::filesystem;

namespace {

constexpr int kMostParts = 256;        // links, degrees of freedom, eigengrasps; as in the schema
constexpr std::size_t kWarnings = 16;  // as in the schema
constexpr std::size_t kLongestName = 64;
constexpr double kFarthest = 10.0;  // from the base to the end of a hand [m]

/// The name of the folder that an archive was made of, as far as the archive's own name tells.
std::string stem_of(const std::string& file_name) {
  const fs::path stem = fs::path(file_name).stem();
  return ending_of(stem.string()) == ".tar" ? stem.stem().string() : stem.string();
}

void require_archive(const std::string& file_name) {
  const std::string ending = ending_of(file_name);
  if (ending == ".zip" || ending == ".tar" || ending == ".tgz") return;
  if (ending == ".gz" && ending_of(fs::path(file_name).stem().string()) == ".tar") return;
  fail("the name ends in '{}', expected an archive of a hand's folder: .zip, .tar or .tar.gz",
       ending.substr(0, 16));
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The hand.yaml that is nearest to the archive's root; of several the one whose folder has the archive's
/// name.
fs::path find_hand_file(const std::vector<fs::path>& files, const std::string& stem) {
  const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
  std::vector<fs::path> found;
  for (const fs::path& file : files) {
    if (file.filename() != "hand.yaml") continue;
    if (!found.empty() && depth(file) < depth(found.front())) found.clear();
    if (found.empty() || depth(file) == depth(found.front())) found.push_back(file);
  }
  if (found.empty())
    fail(
        "the archive holds no hand.yaml, expected a hand's folder: hand.yaml, a URDF and meshes "
        "(docs/hand-format.md)");
  for (const fs::path& file : found)
    if (found.size() == 1 || file.parent_path().filename() == stem) return file;
  fail("the archive holds {} hands ({}, {}), expected one, or one whose folder has the archive's name, '{}'",
       found.size(), found[0].parent_path().filename().string(), found[1].parent_path().filename().string(),
       stem.substr(0, kLongestName));
}

void require_whole_meshes(const std::vector<fs::path>& files) {
  for (const fs::path& file : files)
    if (const std::string ending = ending_of(file.string()); ending == ".glb")
      require_whole(ending, read_text_file(file));
}

void require_size(const HandModel& hand, std::int64_t max_triangles) {
  const auto at_most = [](const char* what, int count) {
    if (count > kMostParts) fail("the hand has {} {}, expected at most {}", count, what, kMostParts);
  };
  at_most("links", hand.n_links());
  at_most("degrees of freedom", hand.n_dof());
  at_most("eigengrasps", hand.eigengrasps.size());
  std::int64_t triangles = 0;
  for (const HandLink& link : hand.links) {
    if (link.name.size() > kLongestName)
      fail("the link '{}...' has a name of {} characters, expected at most {}",
           link.name.substr(0, kLongestName), link.name.size(), kLongestName);
    triangles += static_cast<std::int64_t>(link.mesh.triangles.size());
  }
  if (triangles == 0) fail("the links of the hand have no surface, expected meshes or boxes in its URDF");
  if (triangles > max_triangles)
    fail("the hand has {} triangles, expected at most {}; simplify its meshes", triangles, max_triangles);
  if (const double reach = hand_reach(hand); !(reach <= kFarthest))
    fail("the hand reaches {:.4g} m from its base, expected at most {} m; are its meshes in mm?", reach,
         kFarthest);
}

/// What there is to say of the hand. @throws Error with the worst where no plan could mean anything
std::vector<std::string> findings_of(const HandModel& hand) {
  std::vector<std::string> sentences;
  for (const HandFinding& finding : check_hand(hand)) {
    if (finding.severity == HandFinding::Severity::error) fail("the hand is not sound: {}", finding.sentence);
    if (finding.severity == HandFinding::Severity::warning && sentences.size() < kWarnings)
      sentences.push_back(finding.sentence.substr(0, 1000));
  }
  return sentences;
}

}  // namespace

UploadedHand read_uploaded_hand(const std::string& file_name, const std::string& bytes,
                                const ServerLimits& limits) {
  require_archive(file_name);
  const ScratchFolder scratch;
  try {
    unpack_archive(bytes, scratch.path(),
                   {.unpacked_bytes = limits.unpacked_bytes,
                    .entries = limits.archive_entries,
                    .endings = {".yaml", ".yml", ".urdf", ".obj", ".stl", ".ply", ".off", ".glb"}});
    const std::vector<fs::path> files = files_in(scratch.path());
    require_whole_meshes(files);
    const fs::path file = find_hand_file(files, stem_of(file_name));
    auto hand = std::make_shared<HandModel>(load_hand(file, {.only_within = scratch.path()}));
    require_size(*hand, limits.upload_triangles);
    hand->name = sound_name(hand->name, "hand");
    hand->source.clear();  // nothing that is still there
    return {hand, findings_of(*hand)};
  } catch (const Error& e) {
    throw Error(scratch.hidden_in(e.what()));
  }
}

}  // namespace eigengrasp::server
