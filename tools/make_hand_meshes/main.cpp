// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Makes the link meshes of a hand from its shapes.yaml. Usage: make_hand_meshes HAND_FOLDER [MESH...]
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "polygonise.hpp"
#include "shape_file.hpp"

namespace {

namespace fs = std::filesystem;
using eigengrasp::TriangleMesh;
using eigengrasp::Vec3;

std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# Made by make_hand_meshes from shapes.yaml; metres.\n";
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6 + 0.0; };  // + 0.0: no "-0"
  for (const Vec3& p : mesh.vertices) {
    text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", rounded(p.x()), rounded(p.y()), rounded(p.z()));
  }
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

void make_mesh(const eigengrasp::shapes::ShapeRecipe& recipe, const fs::path& folder) {
  using namespace eigengrasp::shapes;
  TriangleMesh fine = polygonise(recipe.solid, recipe.cell);
  require_closed_manifold(fine, recipe.name);
  const std::size_t n_fine = fine.triangles.size();
  improve(fine, recipe.solid, 2);  // of the needles that marching leaves
  TriangleMesh mesh = decimate(fine, recipe.solid, recipe.triangles);
  improve(mesh, recipe.solid, 10);
  require_closed_manifold(mesh, recipe.name);
  eigengrasp::write_file_atomically(folder / (recipe.name + ".obj"), obj_text(mesh));
  fmt::print("{}: {} triangles (from {})\n", recipe.name, mesh.triangles.size(), n_fine);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: make_hand_meshes HAND_FOLDER [MESH...]\n");
    return 2;
  }
  const std::vector<std::string> wanted(argv + 2, argv + argc);
  try {
    const fs::path folder = argv[1];
    for (const auto& recipe : eigengrasp::shapes::load_shapes(folder / "shapes.yaml")) {
      const bool chosen =
          wanted.empty() || std::find(wanted.begin(), wanted.end(), recipe.name) != wanted.end();
      if (chosen) make_mesh(recipe, folder / "meshes");
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "make_hand_meshes: {}\n", e.what());
    return 2;
  }
  return 0;
}
