// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Archives of strangers: what is unpacked, and what is refused with a sentence.
#include <gtest/gtest.h>

#include <filesystem>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "server/archive.hpp"
#include "server/scratch_folder.hpp"
#include "support/packed_archive.hpp"

namespace eigengrasp::server {
namespace {

namespace fs = std::filesystem;
using testing::ArchiveKind;
using testing::Entry;
using testing::packed;

/// What unpacking says; empty: nothing to complain of.
std::string complaint(const std::string& bytes, const ArchiveLimits& limits = {}) {
  const ScratchFolder folder;
  try {
    unpack_archive(bytes, folder.path(), limits);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

void expect_named(const std::string& sentence, const std::string& part) {
  EXPECT_NE(sentence.find(part), std::string::npos) << "'" << sentence << "' does not name " << part;
}

TEST(Archive, FilesComeOutAsTheyWentIn) {
  const std::vector<Entry> entries = {{"hand", "", AE_IFDIR},
                                      {"hand/hand.yaml", "name: x\n"},
                                      {"./hand/meshes/palm.obj", std::string(200'000, 'v')},
                                      {"hand/README", "left out"},
                                      {"__MACOSX/hand.yaml", "left out"},
                                      {"hand/._hand.yaml", "left out"}};
  for (const ArchiveKind kind : {ArchiveKind::tar, ArchiveKind::tar_gz, ArchiveKind::zip}) {
    const ScratchFolder folder;
    unpack_archive(packed(entries, kind), folder.path(), {.endings = {".yaml", ".obj"}});
    EXPECT_EQ(read_text_file(folder.path() / "hand/hand.yaml"), "name: x\n");
    EXPECT_EQ(read_text_file(folder.path() / "hand/meshes/palm.obj"), std::string(200'000, 'v'));
    for (const char* left_out : {"hand/README", "__MACOSX", "hand/._hand.yaml"})
      EXPECT_FALSE(fs::exists(folder.path() / left_out)) << left_out;
  }
}

TEST(Archive, PathsThatLeadOutAreRefused) {
  const ScratchFolder outside;
  const std::string absolute = (outside.path() / "planted.yaml").string();
  for (const ArchiveKind kind : {ArchiveKind::tar, ArchiveKind::zip}) {
    expect_named(complaint(packed({{"../planted.yaml", "x"}}, kind)), "../planted.yaml");
    expect_named(complaint(packed({{"a/../../planted.yaml", "x"}}, kind)), "(..)");
    expect_named(complaint(packed({{absolute, "x"}}, kind)), "absolute");
    expect_named(complaint(packed({{"C:planted.yaml", "x"}}, kind)), "colon");
  }
  expect_named(complaint(packed({{"a\\..\\planted.yaml", "x"}})), "backslash");
  // in a .zip the library reads it as a slash
  expect_named(complaint(packed({{"a\\..\\planted.yaml", "x"}}, ArchiveKind::zip)), "(..)");
  EXPECT_TRUE(fs::is_empty(outside.path()));
  EXPECT_FALSE(fs::exists(outside.path().parent_path() / "planted.yaml"));
  expect_named(complaint(packed({{std::string(300, 'a') + ".yaml", "x"}})), "305");
}

TEST(Archive, LinksAndDevicesAreRefused) {
  expect_named(complaint(packed({{"hand.yaml", "", AE_IFLNK, "/etc/passwd"}})), "link");
  expect_named(complaint(packed({{"hand.yaml", "", AE_IFLNK, "/etc/passwd"}}, ArchiveKind::zip)), "link");
  expect_named(complaint(packed({{"a.yaml", "x"}, {"b.yaml", "", AE_IFREG, "a.yaml"}})), "link");
  expect_named(complaint(packed({{"d", "", AE_IFLNK, "/tmp"}, {"d/planted.yaml", "x"}})), "link");
  expect_named(complaint(packed({{"pipe.yaml", "", AE_IFIFO}})), "regular");
}

TEST(Archive, BombsAreRefusedWhetherTheirFilesAreKeptOrNot) {
  const std::string zeros(std::size_t{4} << 20, '\0');
  for (const char* path : {"big.obj", "big.left-out"})
    for (const ArchiveKind kind : {ArchiveKind::tar_gz, ArchiveKind::zip}) {
      const std::string bomb = packed({{path, zeros}}, kind);
      EXPECT_LT(bomb.size(), 20'000U);
      expect_named(complaint(bomb, {.unpacked_bytes = 1 << 20, .endings = {".obj"}}), "1048576 bytes");
    }
  std::vector<Entry> many;
  for (int i = 0; i < 30; ++i) many.push_back({"file" + std::to_string(i) + ".yaml", "x"});
  expect_named(complaint(packed(many), {.entries = 20}), "20 files");
  EXPECT_EQ(complaint(packed(many), {.entries = 30}), "");
}

TEST(Archive, WhatIsDamagedIsRefused) {
  expect_named(complaint(""), "archive");
  expect_named(complaint("no archive at all, but some text that is long enough to be one"), "archive");
  const std::string noise = [] {
    std::string text;
    unsigned state = 1;
    for (int i = 0; i < 20'000; ++i)
      text += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
    return text;
  }();
  for (const ArchiveKind kind : {ArchiveKind::tar, ArchiveKind::tar_gz, ArchiveKind::zip}) {
    const std::string whole = packed({{"hand.yaml", noise}}, kind);
    EXPECT_EQ(complaint(whole), "");
    for (const std::size_t part : {2U, 3U, 10U})
      EXPECT_NE(complaint(whole.substr(0, whole.size() / part)), "") << part;
  }
}

TEST(Archive, APathTwiceIsRefused) {
  expect_named(complaint(packed({{"a.yaml", "1"}, {"./a.yaml", "2"}})), "twice");
  expect_named(complaint(packed({{"a.obj", "1"}, {"a.obj/b.obj", "2"}})), "a.obj/b.obj");
}

}  // namespace
}  // namespace eigengrasp::server
