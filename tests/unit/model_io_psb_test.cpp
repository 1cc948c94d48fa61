// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The layout of the Princeton Shape Benchmark, against a folder written by hand and the benchmark itself.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/model_io/psb_io.hpp"
#include "support/test_data.hpp"

namespace eigengrasp {
namespace {

namespace fs = std::filesystem;

class Psb : public ::testing::Test {
 protected:
  Psb() : root_(fs::temp_directory_path() / fmt::format("eigengrasp_psb_{}", ::getpid())) {}
  ~Psb() override {
    std::error_code ec;
    fs::remove_all(root_, ec);
  }
  void write(const std::string& classes) const {
    write_file_atomically(root_ / "classification" / "v1" / "base" / "train.cla", classes);
    write_file_atomically(root_ / "db" / "0" / "m7" / "m7.off", "OFF\n");
    write_file_atomically(root_ / "db" / "0" / "m9" / "m9.off", "OFF\n");
  }
  std::string error() const {
    try {
      load_psb(root_);
    } catch (const Error& e) {
      return e.what();
    }
    return "(no error)";
  }
  fs::path root_;
};

TEST_F(Psb, classes_are_tags_outermost_first_and_absent_models_are_named) {
  write("PSB 1\n3 2\n\naircraft 0 0\n\nairplane aircraft 0\n\ncommercial airplane airplane 2\n7\n8\n");
  const PsbLibrary psb = load_psb(root_);
  ASSERT_EQ(psb.models.size(), 2u);
  EXPECT_EQ(psb.models[0].number, 7);
  EXPECT_EQ(psb.models[0].tags, (std::vector<std::string>{"aircraft", "airplane", "commercial airplane"}));
  EXPECT_TRUE(psb.models[1].tags.empty());
  EXPECT_EQ(psb.absent, std::vector<int>{8});
}

TEST_F(Psb, damaged_classifications_are_refused_with_the_line) {
  write("PSB 1\n1 2\n\naircraft 0 2\n7\n");
  EXPECT_NE(error().find("train.cla:5"), std::string::npos) << error();
  write("PSB 1\n1 2\n\naircraft 0 2\n7\nx\n");
  EXPECT_NE(error().find("train.cla:6"), std::string::npos) << error();
  write("PSB 1\n1 2\n\naircraft nowhere 0\n");
  EXPECT_NE(error().find("train.cla:4"), std::string::npos) << error();
  fs::remove_all(root_ / "db");
  EXPECT_NE(error().find("not the Princeton Shape Benchmark"), std::string::npos) << error();
}

TEST(PsbData, has_1809_meshes_and_5_absent_models) {
  const fs::path folder = testing::test_data("psb_v1");
  EIGENGRASP_REQUIRE_DATA(folder);
  const PsbLibrary psb = load_psb(folder);
  EXPECT_EQ(psb.models.size(), 1809u);
  EXPECT_EQ(psb.absent, (std::vector<int>{303, 1120, 1377, 1541, 1755}));
  const auto tagless =
      std::count_if(psb.models.begin(), psb.models.end(), [](const auto& m) { return m.tags.empty(); });
  EXPECT_EQ(tagless, 0);
}

}  // namespace
}  // namespace eigengrasp
