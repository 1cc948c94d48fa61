// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/point_cloud.hpp"

#include <gtest/gtest.h>
#include <liblzf/lzf.h>

#include <cstring>
#include <limits>

#include "support/written_files.hpp"

namespace eigengrasp {
namespace {

struct PointCloudFile : ::testing::Test {
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    return folder.write(name, content);
  }
  std::string refusal(const std::string& name, const std::string& content) const {
    return testing::error_of([&] { load_point_cloud(write(name, content)); });
  }

  testing::TempFolder folder;
};

std::string floats(std::initializer_list<float> numbers) {
  std::string bytes;
  for (const float x : numbers) bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  return bytes;
}

constexpr const char* kPcdHead =
    "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0.1 0 0.5 1 0 0 0\nPOINTS 2\n";

TEST_F(PointCloudFile, PlyTextWithRangeGridAndNan) {
  const auto file = write("a.ply",
                          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                          "property float z\nelement range_grid 2\nproperty list uchar int vertex_indices\n"
                          "end_header\n1 2 3\nnan nan NaN\n4 5 6\n1 0\n0\n");
  const PointCloud cloud = load_point_cloud(file, 0.001);
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.dropped, 1U);
  EXPECT_EQ(cloud.points[1], Vec3(4.0, 5.0, 6.0) * 0.001);
  EXPECT_TRUE(is_point_cloud_file(file));
}

TEST_F(PointCloudFile, PcdInItsThreeForms) {
  const std::string rows = floats({1, 2, 3, 0, -1, -2, -3, 0});
  const std::string columns = floats({1, -1, 2, -2, 3, -3, 0, 0});
  std::string packed(200, '\0');
  const unsigned size =
      lzf_compress(columns.data(), static_cast<unsigned>(columns.size()), packed.data(), 200);
  ASSERT_GT(size, 0U);
  const std::uint32_t sizes[2] = {size, static_cast<std::uint32_t>(columns.size())};
  std::string head(8, '\0');
  std::memcpy(head.data(), sizes, 8);
  for (const std::string& data : {std::string("DATA ascii\n1 2 3 0\n-1 -2 -3 0\n"), "DATA binary\n" + rows,
                                  "DATA binary_compressed\n" + head + packed.substr(0, size)}) {
    const PointCloud cloud = load_point_cloud(write("a.pcd", kPcdHead + data));
    ASSERT_EQ(cloud.points.size(), 2U);
    EXPECT_EQ(cloud.points[0], Vec3(1, 2, 3));
    EXPECT_EQ(cloud.points[1], Vec3(-1, -2, -3));
    ASSERT_TRUE(cloud.viewpoint.has_value());
    EXPECT_EQ(*cloud.viewpoint, Vec3(0.1, 0.0, 0.5));
  }
}

TEST_F(PointCloudFile, ObjWithoutFacesIsACloudAndWithFacesAMesh) {
  EXPECT_TRUE(is_point_cloud_file(write("a.obj", "v 0 0 0\nv 1 0 0\n")));
  EXPECT_FALSE(is_point_cloud_file(write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")));
  EXPECT_EQ(load_point_cloud(write("a.obj", "v 0 0 0\nv 1 0 0\n")).points.size(), 2U);
}

TEST_F(PointCloudFile, DamagedFilesAreExplained) {
  const std::string head = kPcdHead;
  EXPECT_NE(refusal("a.pcd", head + "DATA binary\n" + floats({1, 2})).find("cut off"), std::string::npos);
  EXPECT_NE(refusal("a.pcd", head + "DATA ascii\n1 2 3 0\n").find("after 1 of 2"), std::string::npos);
  EXPECT_NE(refusal("a.pcd", head + "DATA ascii\n1 2\n").find(":"), std::string::npos);
  EXPECT_NE(refusal("a.pcd", head + "DATA zip\n").find("binary_compressed"), std::string::npos);
  EXPECT_NE(refusal("a.pcd", head + "DATA binary_compressed\n\1\1").find("cut off"), std::string::npos);
  EXPECT_NE(refusal("a.pcd", "FIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n").find("no field z"),
            std::string::npos);
  EXPECT_NE(refusal("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nend_header\nnan nan nan\n")
                .find("no point with finite"),
            std::string::npos);
  EXPECT_THROW(load_point_cloud(folder.path() / "none.ply"), Error);
}

TEST(PointCloud, SpacingOfAGrid) {
  std::vector<Vec3> grid;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) grid.emplace_back(0.002 * i, 0.002 * j, 0.0);
  EXPECT_NEAR(point_spacing(grid), 0.002, 1e-9);
}

}  // namespace
}  // namespace eigengrasp
