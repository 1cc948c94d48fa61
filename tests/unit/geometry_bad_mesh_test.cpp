// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Each bad file ends as one sentence. The sentences are those of this program (self); a change is to be read.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/geometry/object_model.hpp"
#include "support/test_data.hpp"
#include "unit/geometry_shapes.hpp"

namespace eigengrasp::testing {
namespace {

namespace fs = std::filesystem;

/// The error of reading a file, without the file's name at its beginning; empty where it is read.
std::string error_of(const fs::path& file, double scale = 1.0) {
  try {
    load_mesh(file, {.scale = scale});
    return "";
  } catch (const Error& e) {
    const std::string sentence = e.what();
    EXPECT_EQ(sentence.rfind(file.string(), 0), 0u) << sentence;
    return sentence.substr(std::min(sentence.size(), file.string().size()));
  }
}

struct BadFile {
  std::string name, error;
};

const std::vector<BadFile> kBadFiles = {
    {"bad_accessor_count.gltf",
     ": the 100000000 entries of the positions reach beyond their buffer; export it again"},
    {"bad_accessor_index.gltf", ": names accessor 9, but there are only 2; export it again"},
    {"bad_accessor_negative.gltf",
     ": \"count\" is -1, expected a positive integer of 32 bits; export it again"},
    {"bad_array.gltf", ": has no \"asset\", so it is not a glTF file; export it again"},
    {"bad_ascii_empty.stl", ": has no triangles, expected a surface; export faces as well"},
    {"bad_ascii_two.stl", ":6: found \"endloop\" where \"vertex\" was expected; mend the line"},
    {"bad_bin_chunk.glb",
     ": a chunk at byte 636 reaches beyond the end of the file; it is cut off or damaged"},
    {"bad_binary_junk.obj",
     ": has neither vertices (v) nor faces (f), so it is not a Wavefront OBJ file; check what it is"},
    {"bad_buffer_length.gltf",
     ": a buffer has 168 bytes, expected 4000000000; it is cut off; export it again"},
    {"bad_buffer_missing.gltf",
     ": its numbers are in the file \"missing.bin\", which is missing; put it beside"},
    {"bad_chunk.glb", ": a chunk at byte 12 reaches beyond the end of the file; it is cut off or damaged"},
    {"bad_cloud.ply", ": is a cloud of 8 points without faces, expected a surface; reconstruct one first"},
    {"bad_count.dae", ":58: \"count=\"4000000000\"\" is no number that fits the file; export the mesh again"},
    {"bad_count.stl",
     ": has 684 bytes, expected 200000000084 for the 4000000000 triangles of its header; it is cut off or "
     "not an STL file"},
    {"bad_counts.off",
     ":2: says 4000000000 vertices and 4000000000 faces, but the file has only 136 bytes; export the mesh "
     "again"},
    {"bad_cut.gltf", ": is not valid JSON, expected a glTF document; it is cut off or not a glTF file"},
    {"bad_cut_face.obj", ":20: the face has 2 corners, expected at least 3; the file may be cut off"},
    {"bad_cycle.gltf", ": node 0 has more than one parent, expected a tree; export it again"},
    {"bad_deep.dae", ":1: nests elements more than 200 deep"},
    {"bad_deep.gltf", ": nests brackets more than 100 deep, so it is not a glTF file; check what it is"},
    {"bad_degenerate_only.obj", ": has no triangles, expected a surface; export faces as well"},
    {"bad_empty.obj", ": is empty, expected a mesh; write the file again"},
    {"bad_face_word.obj", ":9: found \"x\" where a vertex index was expected; mend the line"},
    {"bad_format.ply",
     ":2: the format is \"morse\", expected ascii, binary_little_endian or binary_big_endian"},
    {"bad_header_only.off", ":1: found \"\" where the number of vertices was expected; mend the line"},
    {"bad_header_only.stl",
     ": has 84 bytes, expected 101058054084 for the 2021161080 triangles of its header; it is cut off or not "
     "an STL file"},
    {"bad_huge.obj",
     ": reaches 1e+09 m from its origin, expected at most 1000 km; check the units and the scale"},
    {"bad_huge_count.ply",
     ": says 4000000000 of vertex, but has only 6 bytes of them; it is cut off; export it again"},
    {"bad_huge_count_binary.ply",
     ": says 2000000000 of vertex, but has only 100 bytes of them; it is cut off; export it again"},
    {"bad_index.gltf", ": a triangle uses position 32767, but there are only 8; export it again"},
    {"bad_index.off", ":12: the face uses vertex 8, but there are only 8 (0 to 7); export the mesh again"},
    {"bad_index.ply", ":19: the face uses vertex 8, but there are only 8 (0 to 7); export the mesh again"},
    {"bad_index_beyond.obj",
     ":10: the face uses vertex 9, but there are only 8; the file may be cut off, export the mesh again"},
    {"bad_index_binary.ply",
     ": row 0 of face: the face uses vertex 1073741824, but there are only 8 (0 to 7); export the mesh "
     "again"},
    {"bad_index_huge.obj",
     ":9: found \"99999999999999999999\" where a vertex index was expected; mend the line"},
    {"bad_index_negative.obj",
     ":9: the face uses vertex -9, but there are only 8 so far; export the mesh again"},
    {"bad_index_negative.off",
     ":12: the face uses vertex -1, but there are only 8 (0 to 7); export the mesh again"},
    {"bad_index_negative.ply",
     ":19: the face uses vertex -2, but there are only 8 (0 to 7); export the mesh again"},
    {"bad_index_word.dae", ":73: found \"x\" in the integers of <p>; export the mesh again"},
    {"bad_index_zero.obj", ":9: the face uses vertex 0, but they count from 1; export the mesh again"},
    {"bad_inf.obj", ":8: y is inf, expected a finite number; mend the line"},
    {"bad_is_stl.obj",
     ": has neither vertices (v) nor faces (f), so it is not a Wavefront OBJ file; check what it is"},
    {"bad_lines_only.obj", ": has 8 vertices but no faces, expected a surface; export faces as well"},
    {"bad_list_length.off", ":12: the face has 2000000000 corners, expected 3 to 512; export triangles"},
    {"bad_list_length.ply",
     ": row 0 of face: the face uses vertex 768, but there are only 8 (0 to 7); export the mesh again"},
    {"bad_list_length_ascii.ply", ":19: a list of 2000000000 corners, expected 3 to 512; export triangles"},
    {"bad_matrix.gltf",
     ": reaches 1e+30 m from its origin, expected at most 1000 km; check the units and the scale"},
    {"bad_mesh_index.gltf", ": names mesh 3, but there are only 1; export it again"},
    {"bad_nan.gltf", ": position 0 is not finite, expected three numbers; export it again"},
    {"bad_nan.obj", ":8: x is nan, expected a finite number; mend the line"},
    {"bad_nan.off", ":10: x is nan, expected a finite number; mend the line"},
    {"bad_nan.ply", ":18: a number is nan, expected a finite number; mend the line"},
    {"bad_nan_ascii.stl", ":20: x is nan, expected a finite number; mend the line"},
    {"bad_nan_binary.stl",
     ": triangle 0 has a corner that is not finite, expected numbers; export the mesh again"},
    {"bad_negative_count.ply", ":4: says -8 of vertex, expected 0 or more; mend the line"},
    {"bad_no_elements.ply", ": has no vertices, expected a surface; export it again"},
    {"bad_no_faces.obj", ": has 8 vertices but no faces, expected a surface; export faces as well"},
    {"bad_no_faces.off", ":2: has 8 vertices and 0 faces, expected a surface; export faces as well"},
    {"bad_no_meshes.gltf", ": has no scene, expected one with a mesh; export it again"},
    {"bad_no_vertex.ply", ": has faces before or without vertices, expected vertices first; export it again"},
    {"bad_no_z.ply", ": the vertices have no property z, expected x, y and z; export it again"},
    {"bad_node_index.gltf", ": names node 7, but there are only 2; export it again"},
    {"bad_null.gltf", ": has no \"asset\", so it is not a glTF file; export it again"},
    {"bad_overflow.obj", ":8: y is 1e999, too large for a number; mend the line"},
    {"bad_points.gltf", ": shows no mesh with triangles, expected a surface; export it again"},
    {"bad_self.gltf", ": node 0 has more than one parent, expected a tree; export it again"},
    {"bad_short.glb", ": has 8 bytes, expected at least 20 of a binary glTF file; it is cut off"},
    {"bad_short.stl", ": has 3 bytes, expected at least 84 of an STL file; it is cut off or not an STL file"},
    {"bad_spaces.obj",
     ": has neither vertices (v) nor faces (f), so it is not a Wavefront OBJ file; check what it is"},
    {"bad_sparse.gltf", ": the positions are compressed or sparse, expected plain data; export it again"},
    {"bad_stride.gltf", ": the 8 entries of the positions reach beyond their buffer; export it again"},
    {"bad_text_junk.dae", ":1: has no element COLLADA, so it is not a COLLADA file; check what it is"},
    {"bad_text_junk.gltf", ": is not valid JSON, expected a glTF document; it is cut off or not a glTF file"},
    {"bad_text_junk.obj",
     ": has neither vertices (v) nor faces (f), so it is not a Wavefront OBJ file; check what it is"},
    {"bad_text_junk.off", ":1: begins with \"lorem\", expected \"OFF\"; check what the file is"},
    {"bad_text_junk.ply", ":1: does not begin with \"ply\", so it is not a PLY file; check what it is"},
    {"bad_text_junk.stl",
     ": has 1080 bytes, expected 95995238984 for the 1919904778 triangles of its header; it is cut off or "
     "not an STL file"},
    {"bad_truncated.dae", ":72: ends within an element; the file is cut off"},
    {"bad_truncated.glb", ": has 762 bytes, expected 812 as its header says; it is cut off"},
    {"bad_truncated.off", ":15: the line ends where a vertex index was expected; the file may be cut off"},
    {"bad_truncated.stl",
     ": has 614 bytes, expected 684 for the 12 triangles of its header; it is cut off or not an STL file"},
    {"bad_truncated_ascii.ply", ":27: the line ends where an integer was expected; the file may be cut off"},
    {"bad_truncated_ascii.stl", ":77: found \"endlo\" where \"endloop\" was expected; mend the line"},
    {"bad_truncated_binary.ply", ": ends within row 10 of 12 of face; the file is cut off"},
    {"bad_truncated_header.ply", ":7: ends where \"end_header\" was expected; the file is cut off"},
    {"bad_two_numbers.obj", ":8: the line ends where z was expected; the file may be cut off"},
    {"bad_type.ply", ":7: found \"quad\" where a type such as float or int was expected; mend the line"},
    {"bad_types.gltf", ": \"nodes\" is not a list; export it again"},
    {"bad_view.gltf", ": the 8 entries of the positions reach beyond their buffer; export it again"},
    {"bad_view_offset.gltf", ": the 36 entries of the indices reach beyond their buffer; export it again"},
    {"bad_word.obj", ":8: found \"one\" where y was expected; mend the line"},
    {"bad_zero.stl", ": has no triangles, expected a surface; export faces as well"},
};

TEST(BadMesh, EachFileOfTheCorpusEndsAsItsSentence) {
  std::set<std::string> known;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  std::vector<std::string> errors;
  for (const BadFile& bad : kBadFiles)
    errors.push_back(error_of(source_path("tests/fuzz/corpus/mesh") / bad.name));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  for (std::size_t i = 0; i < kBadFiles.size(); ++i) {
    EXPECT_EQ(errors[i], kBadFiles[i].error) << kBadFiles[i].name;
    known.insert(kBadFiles[i].name);
  }
  for (const auto& entry : fs::directory_iterator(source_path("tests/fuzz/corpus/mesh"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(known.count(name), name.starts_with("bad_") ? 1u : 0u) << name << " has no expected sentence";
  }
}

TEST(BadMesh, MissingFileFolderAndEnding) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("eigengrasp_bad_mesh_{}.obj", ::getpid());
  fs::create_directories(folder);
  EXPECT_EQ(error_of(folder), ": is a folder, expected a mesh file; name a file in it");
  EXPECT_EQ(error_of(folder / "none.obj"), ": there is no such file; check the path");
  std::ofstream(folder / "mesh.txt") << "v 0 0 0\n";
  EXPECT_EQ(
      error_of(folder / "mesh.txt"),
      ": the ending \".txt\" is not that of a mesh file, expected one of obj, stl, ply, off, gltf, glb, "
      "dae, 3ds, fbx; convert or rename the file");
  fs::remove_all(folder);
}

TEST(BadMesh, ScaleMustBePositiveAndFinite) {
  const fs::path cube = source_path("tests/fuzz/corpus/mesh/ok_cube.obj");
  EXPECT_EQ(error_of(cube, 0.0), ": the scale is 0, expected a number above 0");
  EXPECT_EQ(error_of(cube, -1.0), ": the scale is -1, expected a number above 0");
  EXPECT_EQ(error_of(cube, std::numeric_limits<double>::infinity()),
            ": the scale is inf, expected a number above 0");
  EXPECT_EQ(error_of(cube, 1e9),
            ": reaches 1e+09 m from its origin, expected at most 1000 km; check the units and the scale");
}

TEST(BadMesh, TheSizeIsJudgedAfterBothScales) {
  const fs::path huge = source_path("tests/fuzz/corpus/mesh/bad_huge.obj");
  const TriangleMesh mesh = load_mesh(huge, {.scale = 1.0, .later_scale = 1e-9});
  EXPECT_EQ(bounding_box(mesh).size().maxCoeff(), 1e9);  // its vertices are not rescaled yet
  const fs::path cube = source_path("tests/fuzz/corpus/mesh/ok_cube.obj");
  EXPECT_THROW(load_mesh(cube, {.scale = 10.0, .later_scale = 1e6}), Error);
}

/// Files that are cut anywhere are read or refused; text formats may end after a whole number.
TEST(BadMesh, CutAnywhereNeverCrashes) {
  const fs::path file = fs::temp_directory_path() / fmt::format("eigengrasp_cut_{}", ::getpid());
  for (const char* name : {"ok_cube.obj", "ok_cube.off", "ok_cube_ascii.stl", "ok_cube_binary.stl",
                           "ok_cube_ascii.ply", "ok_cube_big.ply", "ok_cube.gltf", "ok_cube.glb"}) {
    SCOPED_TRACE(name);
    std::ifstream in(source_path("tests/fuzz/corpus/mesh") / name, std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(in)), {});
    const fs::path cut = file.string() + fs::path(name).extension().string();
    const bool counted = std::string(name) != "ok_cube.obj";  // an OBJ does not say how many faces it has
    for (std::size_t size = 0; size < content.size(); size += 1 + content.size() / 150) {
      std::ofstream(cut, std::ios::binary) << content.substr(0, size);
      const std::string error = error_of(cut);
      EXPECT_TRUE(!error.empty() || !counted || size + 4 >= content.size()) << size << " bytes";
    }
    fs::remove(cut);
  }
}

std::string sentence_of(const TriangleMesh& mesh) {
  try {
    make_object("cup", mesh);
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

TEST(BadMesh, ObjectOfAnUnsoundMeshIsRefused) {
  EXPECT_EQ(sentence_of({}), "cup: has no triangles, expected a surface; export faces as well");
  TriangleMesh beyond = box_shape();
  beyond.triangles[3][1] = 8;
  EXPECT_EQ(sentence_of(beyond),
            "cup: triangle 3 uses vertex 8, but there are only 8 vertices (0 to 7); export the mesh again");
  TriangleMesh negative = box_shape();
  negative.triangles[0][2] = -1;
  EXPECT_NE(sentence_of(negative), "");
  TriangleMesh nan = box_shape();
  nan.vertices[5].y() = std::nan("");
  EXPECT_EQ(sentence_of(nan), "cup: vertex 5 is not finite, expected three numbers; export the mesh again");
}

}  // namespace
}  // namespace eigengrasp::testing
