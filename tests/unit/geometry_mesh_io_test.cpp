// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// One unit cube in every format, written here by hand, and the laws that hold for each of them.
#include "eigengrasp/geometry/mesh_io.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <fstream>
#include <string>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "support/test_data.hpp"
#include "unit/geometry_shapes.hpp"

namespace eigengrasp::testing {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for every test.
class MeshIo : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("eigengrasp_mesh_io_{}", ::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  fs::path folder_;
};

template <typename T>
std::string raw(T value, bool big = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.vertices) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string off_text(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

std::string stl_text(const TriangleMesh& mesh) {
  std::string text = "solid cube\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vec3& v = mesh.corner(t, k);
      text += fmt::format("vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid cube\n";
}

std::string stl_bytes(const TriangleMesh& mesh) {
  std::string bytes = "solid, though binary" + std::string(60, ' ');
  bytes += raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bytes += std::string(12, '\0');
    for (int k = 0; k < 3; ++k)
      for (const double x : mesh.corner(t, k)) bytes += raw(static_cast<float>(x));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string ply_header(const TriangleMesh& mesh, const std::string& format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment cube\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, mesh.vertices.size(), mesh.triangles.size());
}

std::string ply_text(const TriangleMesh& mesh) {
  std::string text = ply_header(mesh, "ascii");
  for (const Vec3& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

std::string ply_bytes(const TriangleMesh& mesh, bool big) {
  std::string bytes = ply_header(mesh, big ? "binary_big_endian" : "binary_little_endian");
  for (const Vec3& v : mesh.vertices)
    for (const double x : v) bytes += raw(static_cast<float>(x), big);
  for (const auto& t : mesh.triangles) {
    bytes += '\3';
    for (const std::int32_t v : t) bytes += raw(v, big);
  }
  return bytes;
}

/// Positions, then indices.
std::string gltf_buffer(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Vec3& v : mesh.vertices)
    for (const double x : v) bytes += raw(static_cast<float>(x));
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t) bytes += raw(static_cast<std::uint16_t>(v));
  return bytes;
}

std::string gltf_text(const TriangleMesh& mesh, const std::string& uri, const std::string& node) {
  const std::size_t n = mesh.vertices.size(), m = 3 * mesh.triangles.size();
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{}}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"buffers":[{{{}"byteLength":{}}}],"bufferViews":[{{"buffer":0,"byteLength":{}}},
{{"buffer":0,"byteOffset":{},"byteLength":{}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},
{{"bufferView":1,"componentType":5123,"count":{},"type":"SCALAR"}}]}})",
      node, uri.empty() ? "" : fmt::format(R"("uri":"{}",)", uri), 12 * n + 2 * m, 12 * n, 12 * n, 2 * m, n,
      m);
}

std::string glb_bytes(const TriangleMesh& mesh) {
  std::string json = gltf_text(mesh, "", "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string buffer = gltf_buffer(mesh);
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  const auto length = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
  return "glTF" + length(2) + length(28 + json.size() + buffer.size()) + length(json.size()) + "JSON" + json +
         length(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

void expect_unit_cube(const TriangleMesh& mesh) {
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(mesh.vertices.size(), 8u);  // welded
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(report.solid());
  EXPECT_EQ(report.volume, 1.0);
  expect_near(report.box.min, Vec3::Zero(), 0.0);
  expect_near(report.box.max, Vec3::Ones(), 0.0);
}

TEST_F(MeshIo, ReadsTheCubeInEveryFormat) {
  const TriangleMesh cube = box_shape();
  write("cube data.bin", gltf_buffer(cube));
  const std::vector<std::pair<std::string, std::string>> files = {
      {"cube.obj", obj_text(cube)},
      {"CUBE.OBJ", obj_text(cube)},
      {"cube.off", off_text(cube)},
      {"text.stl", stl_text(cube)},
      {"binary.stl", stl_bytes(cube)},
      {"text.ply", ply_text(cube)},
      {"little.ply", ply_bytes(cube, false)},
      {"big.ply", ply_bytes(cube, true)},
      {"cube.gltf", gltf_text(cube, "cube%20data.bin", "")},
      {"cube.glb", glb_bytes(cube)}};
  for (const auto& [name, content] : files) {
    SCOPED_TRACE(name);
    const fs::path file = write(name, content);
    EXPECT_TRUE(is_mesh_file(file));
    expect_unit_cube(load_mesh(file));
    EXPECT_DOUBLE_EQ(inspect_mesh(load_mesh(file, {.scale = 0.5})).volume, 0.125);
    EXPECT_EQ(load_mesh(file).triangles, load_mesh(file).triangles);
  }
}

TEST_F(MeshIo, ReadsTheGoodFilesOfTheCorpus) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(source_path("tests/fuzz/corpus/mesh"))) {
    if (!entry.path().filename().string().starts_with("ok_")) continue;
    SCOPED_TRACE(entry.path().filename());
    const MeshReport report = inspect_mesh(load_mesh(entry.path()));
    EXPECT_TRUE(report.solid());
    EXPECT_NEAR(report.volume, 1.0, 1e-6);
    ++files;
  }
  EXPECT_GT(files, 15);
}

TEST_F(MeshIo, PlacesNodesOfGltf) {
  const TriangleMesh cube = box_shape();
  write("cube.bin", gltf_buffer(cube));
  const std::string node =
      R"(,"translation":[10,0,0],"rotation":[0,0,0.70710678118,0.70710678118],"scale":[2,1,1])";
  const TriangleMesh placed = load_mesh(write("placed.gltf", gltf_text(cube, "cube.bin", node)));
  const Box box = bounding_box(placed);
  expect_near(box.min, Vec3(9, 0, 0), 1e-6);
  expect_near(box.max, Vec3(10, 2, 1), 1e-6);
  EXPECT_NEAR(inspect_mesh(placed).volume, 2.0, 1e-5);
  const std::string mirror = R"(,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])";
  EXPECT_NEAR(inspect_mesh(load_mesh(write("mirrored.gltf", gltf_text(cube, "cube.bin", mirror)))).volume,
              1.0, 1e-6);
}

TEST_F(MeshIo, CutsConcavePolygons) {
  const std::string text = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n";
  const TriangleMesh mesh = load_mesh(write("concave.obj", text));
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_NEAR(surface_area(mesh), 2.5, 1e-12);
}

TEST_F(MeshIo, KeepsDetailFarBelowAMillimetre) {
  TriangleMesh small = box_shape(Vec3::Constant(4e-6));
  const TriangleMesh read = load_mesh(write("small.obj", obj_text(small)));
  EXPECT_EQ(read.vertices.size(), 8u);
  EXPECT_EQ(read.triangles.size(), 12u);
}

TEST_F(MeshIo, ReadsAFirstCoordinateWhoseBytesBeginWithALinesEnd) {
  for (const std::uint32_t bits : {0x3EE5690Au, 0x3EE5690Du, 0x3EE50A0Du, 0x3EE56920u, 0x3EE50D0Au}) {
    const double x = std::bit_cast<float>(bits);
    TriangleMesh mesh;
    mesh.vertices = {{x, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const TriangleMesh read = load_mesh(write("end.off", off_text(mesh)));
    ASSERT_EQ(read.vertices.size(), 3u) << bits;
    EXPECT_EQ(bounding_box(read).min.x(), 0.0) << bits;
    EXPECT_NEAR(surface_area(read), surface_area(mesh), 1e-6) << bits;
    EXPECT_EQ(load_mesh(write("end.obj", obj_text(mesh))).vertices.size(), 3u) << bits;
  }
}

TEST_F(MeshIo, IgnoresWhatSurroundsTheFacesOfAnObj) {
  const std::string text =
      "\xef\xbb\xbf# comment\nmtllib none.mtl\n  v 0 0 0 # origin\nv 1 0 0 0.5 0.5 0.5\n\tv 0 1 0 1\n"
      "vt 0 0\nvn 0 0 1\ng a b\nusemtl red\ns 1\nl 1 2\np 1\nf 1/1/1 2//1 3/9 # last\n";
  EXPECT_EQ(load_mesh(write("odd.obj", text)).triangles.size(), 1u);
}

TEST_F(MeshIo, SameBytesSameMesh) {
  const fs::path file = write("sphere.obj", obj_text(sphere_shape(4)));
  const TriangleMesh a = load_mesh(file), b = load_mesh(file);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.vertices, b.vertices);
}

TEST_F(MeshIo, SixteenThousandTrianglesInATenthOfASecond) {
  TriangleMesh large = sphere_shape(5);  // 8192 triangles
  append(large, sphere_shape(5));
  transform(large, Pose::Identity(), 0.1);
  const fs::path file = write("large.obj", obj_text(large));
  double best = 1e9;
  for (int run = 0; run < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(load_mesh(file).triangles.size(), 16384u);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  RecordProperty("seconds", std::to_string(best));
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(best, 0.1);
#endif
}

TEST(Units, AreKnownByName) {
  EXPECT_EQ(unit_length("m"), 1.0);
  EXPECT_EQ(unit_length("cm"), 0.01);
  EXPECT_EQ(unit_length("mm"), 0.001);
  EXPECT_EQ(unit_length("in"), 0.0254);
  try {
    unit_length("furlong");
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "unknown unit \"furlong\", expected m, cm, mm or in");
  }
}

TEST(MeshFile, IsKnownByItsEnding) {
  EXPECT_TRUE(is_mesh_file("a/b.Stl"));
  EXPECT_TRUE(is_mesh_file("b.GLB"));
  EXPECT_FALSE(is_mesh_file("hand.xml"));
  EXPECT_FALSE(is_mesh_file("cube.iv"));
  EXPECT_FALSE(is_mesh_file("obj"));
  EXPECT_FALSE(is_mesh_file(""));
}

}  // namespace
}  // namespace eigengrasp::testing
