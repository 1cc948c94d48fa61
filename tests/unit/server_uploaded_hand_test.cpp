// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Hands that clients send as archives.
#include <gtest/gtest.h>

#include <filesystem>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "server/model_shelf.hpp"
#include "server/uploaded_hand.hpp"
#include "support/packed_archive.hpp"

namespace eigengrasp::server {
namespace {

namespace fs = std::filesystem;
using testing::ArchiveKind;
using testing::Entry;
using testing::packed;

const fs::path kHands = fs::path(EIGENGRASP_SOURCE_DIR) / "data/hands";

/// The files of a shipped hand, in a folder of that name.
std::vector<Entry> files_of(const std::string& hand) {
  std::vector<Entry> entries;
  for (const auto& file : fs::recursive_directory_iterator(kHands / hand))
    if (file.is_regular_file())
      entries.push_back({fs::relative(file.path(), kHands).string(), read_text_file(file.path())});
  return entries;
}

/// The entries with a part of one file's text replaced.
std::vector<Entry> with(std::vector<Entry> entries, const std::string& file, const std::string& from,
                        const std::string& to) {
  for (Entry& entry : entries) {
    if (entry.path != file) continue;
    const auto at = entry.content.find(from);
    EXPECT_NE(at, std::string::npos) << file << " lacks " << from;
    if (at != std::string::npos) entry.content.replace(at, from.size(), to);
  }
  return entries;
}

std::string refusal_of(const std::string& name, const std::string& bytes, const ServerLimits& limits = {}) {
  try {
    read_uploaded_hand(name, bytes, limits);
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find("eigengrasp-upload-"), std::string::npos) << e.what();
    return e.what();
  }
  return "no error";
}

void expect_named(const std::string& sentence, const std::string& part) {
  EXPECT_NE(sentence.find(part), std::string::npos) << "'" << sentence << "' does not name " << part;
}

TEST(UploadedHand, IsTheHandThatWasPacked) {
  const HandModel shipped = load_hand(kHands / "barrett-metal");
  const std::vector<Entry> files = files_of("barrett-metal");
  for (const auto& [name, kind] : {std::pair{"b.zip", ArchiveKind::zip},
                                   {"b.tar", ArchiveKind::tar},
                                   {"b.tar.gz", ArchiveKind::tar_gz},
                                   {"B.TGZ", ArchiveKind::tar_gz}}) {
    const UploadedHand hand = read_uploaded_hand(name, packed(files, kind), {});
    EXPECT_EQ(hand.model->name, "barrett-metal") << name;
    EXPECT_EQ(hand.model->dof_names(), shipped.dof_names());
    ASSERT_EQ(hand.model->n_links(), shipped.n_links());
    EXPECT_EQ(hand.model->links[0].mesh.vertices, shipped.links[0].mesh.vertices);
    EXPECT_TRUE(hand.model->source.empty());
  }
}

TEST(UploadedHand, MayBeBasedOnAnotherInItsArchive) {
  std::vector<Entry> both = files_of("barrett-metal");
  for (const Entry& entry : files_of("barrett-rubber")) both.push_back(entry);
  EXPECT_EQ(read_uploaded_hand("barrett-rubber.tar", packed(both), {}).model->name, "barrett-rubber");
  expect_named(refusal_of("both.tar", packed(both)), "2 hands (barrett-metal, barrett-rubber)");
  expect_named(refusal_of("barrett-rubber.tar", packed(files_of("barrett-rubber"))), "does not exist");
}

TEST(UploadedHand, IsRefusedWhereItIsUnsound) {
  const std::vector<Entry> files = files_of("barrett-metal");
  const std::string yaml = "barrett-metal/hand.yaml";
  expect_named(refusal_of("hand.rar", packed(files)), ".rar");
  expect_named(refusal_of("hand.zip", packed({{"notes.yaml", "x"}})), "no hand.yaml");
  expect_named(refusal_of("hand.zip", packed({{"hand.yaml", "format: [\n"}})), "hand.yaml");
  expect_named(refusal_of("h.tar", packed(with(files, yaml, "urdf: ", "urdf: ../../"))), "lies outside");
  expect_named(refusal_of("h.tar", packed(with(files, yaml, "urdf: ", "urdf: missing-"))), "does not exist");
  const std::string shape = "<collision><geometry><mesh filename=\"";
  const auto strange = with(files, "barrett-metal/barrett.urdf", shape, shape + "file:///");
  expect_named(refusal_of("h.tar", packed(strange)), "lies outside");
  expect_named(refusal_of("h.tar", packed(files), {.upload_triangles = 10}), "triangles");
  expect_named(refusal_of("h.tar", packed(files), {.unpacked_bytes = 5000}), "5000 bytes");
  expect_named(refusal_of("h.tar", packed(files), {.archive_entries = 3}), "3 files");
}

TEST(UploadedHand, StandsOnTheShelfBesideTheOthers) {
  ModelShelf shelf("", "", {.uploads = 2});
  const std::string bytes = packed(files_of("barrett-metal"), ArchiveKind::zip);
  EXPECT_EQ(shelf.upload_hand("b.zip", bytes).name, "barrett-metal-2");  // the first is the shipped one
  EXPECT_EQ(shelf.upload_hand("b.zip", bytes).name, "barrett-metal-3");
  EXPECT_EQ(shelf.hand("barrett-metal-2")->name, "barrett-metal-2");
  int uploaded = 0;
  for (const wire::HandEntry& entry : shelf.hands()) uploaded += entry.uploaded ? 1 : 0;
  EXPECT_EQ(uploaded, 2);
  EXPECT_FALSE(shelf.hand_glb("barrett-metal-3")->empty());
  try {
    shelf.upload_hand("b.zip", bytes);
    ADD_FAILURE() << "a third upload was kept";
  } catch (const Error& e) {
    expect_named(e.what(), "--max-uploads");
  }
}

}  // namespace
}  // namespace eigengrasp::server
