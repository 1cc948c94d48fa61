// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Meshes of real things, whose sizes are known from the things themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/geometry/object_checks.hpp"
#include "eigengrasp/geometry/registered_scans.hpp"
#include "support/test_data.hpp"

namespace eigengrasp::testing {
namespace {

namespace fs = std::filesystem;

TEST(YcbObjects, AreSolidsOfTheSizeOfHouseholdThings) {
  const fs::path folder = test_data("ycb");
  EIGENGRASP_REQUIRE_DATA(folder);
  int objects = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!is_mesh_file(entry.path())) continue;
    SCOPED_TRACE(entry.path().filename());
    const MeshReport report = inspect_mesh(load_mesh(entry.path()));
    EXPECT_TRUE(report.watertight);
    EXPECT_TRUE(report.solid());
    EXPECT_GT(report.volume, 1e-5);  // 10 ml
    EXPECT_LT(report.volume, 4e-3);  // 4 l
    EXPECT_GT(report.volume, 0.02 * report.box.size().prod());
    EXPECT_LT(report.volume, report.box.size().prod());
    EXPECT_TRUE(size_warnings(report, 0.2).empty());
    ++objects;
  }
  EXPECT_EQ(objects, 24);
}

/// Published sizes of the YCB set (Calli et al. 2015, table 2): the volume of simple shapes follows.
TEST(YcbObjects, VolumeVsPublishedSize) {
  const fs::path folder = test_data("ycb");
  EIGENGRASP_REQUIRE_DATA(folder);
  const double pi = 3.14159265358979;
  const std::map<std::string, double> published = {
      {"003_cracker_box.obj", 0.060 * 0.158 * 0.210},
      {"005_tomato_soup_can.obj", pi / 4 * 0.066 * 0.066 * 0.101},
      {"056_tennis_ball.obj", pi / 6 * 0.0647 * 0.0647 * 0.0647},
      {"061_foam_brick.obj", 0.050 * 0.075 * 0.050},
      {"077_rubiks_cube.obj", 0.057 * 0.057 * 0.057}};
  for (const auto& [name, volume] : published)
    EXPECT_NEAR(inspect_mesh(load_mesh(folder / name)).volume / volume, 1.0, 0.25) << name;
}

TEST(ScannedMesh, BunnyIsOpenAndRangeImagesAreClouds) {
  const fs::path bunny = test_data("scans/bunny/bun_zipper_res2.ply");
  EIGENGRASP_REQUIRE_DATA(bunny);
  const MeshReport report = inspect_mesh(load_mesh(bunny));
  EXPECT_FALSE(report.watertight);  // the scan has holes in its base
  EXPECT_GT(report.boundary_edges, 0);
  EXPECT_NEAR(report.box.size().maxCoeff(), 0.155, 0.01);
}

// The complete bunny was made of these scans and others, in one frame.
TEST(ScannedMesh, RegisteredRangeScansLieOnTheCompleteModel) {
  const fs::path list = test_data("scans/bunny/bun.conf");
  EIGENGRASP_REQUIRE_DATA(list);
  const MeshBvh complete(load_mesh(list.parent_path() / "bun_zipper_res2.ply"));
  const RegisteredScans scans = load_registered_scans(list);
  ASSERT_EQ(scans.views.size(), 4U);
  EXPECT_EQ(scans.missing.size(), 6U);
  for (std::size_t k = 0; k < scans.views.size(); ++k) {
    double squares = 0.0;
    int n = 0;
    for (std::size_t i = 0; i < scans.views[k].points.size(); i += 97, ++n)
      squares += std::pow(complete.closest_point(scans.views[k].points[i]).distance, 2);
    EXPECT_LT(std::sqrt(squares / n), 0.0003) << scans.names[k];
  }
}

}  // namespace
}  // namespace eigengrasp::testing
