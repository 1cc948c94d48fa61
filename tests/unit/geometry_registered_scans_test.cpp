// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/registered_scans.hpp"

#include <gtest/gtest.h>

#include "support/written_files.hpp"

namespace eigengrasp {
namespace {

struct RegisteredScansFile : ::testing::Test {
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    return folder.write(name, content);
  }
  std::string refusal(const std::string& content) const {
    return testing::error_of([&] { load_registered_scans(write("list.conf", content)); });
  }

  testing::TempFolder folder;
};

// A quarter turn about y, as a quaternion whose inverse turns the scan: x to z, z to -x.
constexpr const char* kList =
    "camera 0 0 -1 0 0 0 1\n"
    "bmesh front.obj 0 0 0 0 0 0 1\n"
    "bmesh side.obj 1 2 3 0 0.70710678 0 0.70710678\n"
    "bmesh gone.obj 0 0 0 0 0 0 1\n";

TEST_F(RegisteredScansFile, PlacesEachScanAndItsSensorAndTellsWhatIsMissing) {
  write("front.obj", "v 1 2 3\n");
  write("side.obj", "v 1 0 0\nv 0 0 1\n");
  const RegisteredScans scans = load_registered_scans(write("list.conf", kList));
  ASSERT_EQ(scans.views.size(), 2U);
  EXPECT_EQ(scans.names, (std::vector<std::string>{"front", "side"}));
  EXPECT_EQ(scans.missing, std::vector<std::string>{"gone.obj"});
  EXPECT_EQ(scans.views[0].points.at(0), Vec3(1, 2, 3));
  EXPECT_EQ(*scans.views[0].viewpoint, Vec3(0, 0, 1));
  EXPECT_TRUE(scans.views[1].points.at(0).isApprox(Vec3(1, 2, 3) + Vec3(0, 0, 1), 1e-7));
  EXPECT_TRUE(scans.views[1].points.at(1).isApprox(Vec3(1, 2, 3) + Vec3(-1, 0, 0), 1e-7));
  EXPECT_TRUE(scans.views[1].viewpoint->isApprox(Vec3(0, 2, 3), 1e-7));
}

TEST_F(RegisteredScansFile, UnitsScalePointsAndTranslationsButNotTheSensorsDistance) {
  write("front.obj", "v 1 2 3\n");
  const auto list = write("list.conf", "bmesh front.obj 10 0 0 0 0 0 1\n");
  const RegisteredScans scans = load_registered_scans(list, 0.001);
  EXPECT_TRUE(scans.views.at(0).points.at(0).isApprox(Vec3(0.011, 0.002, 0.003), 1e-12));
  EXPECT_TRUE(scans.views.at(0).viewpoint->isApprox(Vec3(0.01, 0.0, 1.0), 1e-12));
}

TEST_F(RegisteredScansFile, ACloudIsOneView) {
  EXPECT_EQ(load_views(write("a.obj", "v 0 0 0\nv 1 0 0\n")).size(), 1U);
  EXPECT_EQ(load_views(write("list.conf", "bmesh a.obj 0 0 0 0 0 0 1\n")).size(), 1U);
}

TEST_F(RegisteredScansFile, DamagedListsAreExplained) {
  write("a.obj", "v 0 0 0\n");
  EXPECT_NE(refusal("").find("lists 0 scans"), std::string::npos);
  EXPECT_NE(refusal("bmesh gone.obj 0 0 0 0 0 0 1\n").find("none of which is there"), std::string::npos);
  EXPECT_NE(refusal("mesh a.obj\n").find("list.conf:1"), std::string::npos);
  EXPECT_NE(refusal("bmesh\n").find("the file of a scan"), std::string::npos);
  EXPECT_NE(refusal("bmesh a.obj 0 0 0 0 0\n").find("quaternion"), std::string::npos);
  EXPECT_NE(refusal("bmesh a.obj 0 0 0 0 0 0 2\n").find("length 2"), std::string::npos);
  EXPECT_NE(refusal("bmesh a.obj 0 zero 0 0 0 0 1\n").find("\"zero\""), std::string::npos);
  EXPECT_NE(refusal("bmesh a.obj nan 0 0 0 0 0 1\n").find("translation"), std::string::npos);
}

}  // namespace
}  // namespace eigengrasp
