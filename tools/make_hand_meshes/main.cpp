// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Makes the link meshes of a hand from its shapes.yaml. Usage: make_hand_meshes HAND_FOLDER [MESH...]
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/modeling/decimate.hpp"
#include "eigengrasp/modeling/mesh_tools.hpp"
#include "eigengrasp/modeling/polygonise.hpp"
#include "shape_file.hpp"

namespace {

namespace fs = std::filesystem;
namespace modeling = eigengrasp::modeling;
using eigengrasp::TriangleMesh;
using eigengrasp::Vec3;
constexpr double mm = 1e-3;

/// To the six decimals of the file, so that the checks see what a reader sees.
void round_vertices(TriangleMesh& mesh) {
  for (Vec3& p : mesh.vertices) p = (p * 1e6).array().round() * 1e-6 + 0.0;  // + 0.0: no "-0"
}

/// Does the step, and takes it back where it made triangles cut each other.
template <typename Step>
void careful(TriangleMesh& mesh, const Step& step) {
  const TriangleMesh before = mesh;
  step();
  if (modeling::inspect(mesh).intersections > modeling::inspect(before).intersections) mesh = before;
}

TriangleMesh surface_of(const eigengrasp::shapes::ShapeRecipe& recipe) {
  TriangleMesh mesh = modeling::polygonise(recipe.solid, recipe.cell);
  modeling::DecimateOptions options;
  options.min_quality = 0.2;
  // In two steps: what is a needle after the first is among the cheapest to collapse in the second.
  for (const double surplus : {1.1, 1.0}) {
    options.target_triangles = static_cast<std::size_t>(surplus * static_cast<double>(recipe.triangles));
    modeling::decimate(mesh, options);
    for (int i = 0; i < 4; ++i) {
      careful(mesh, [&] { modeling::flip_edges(mesh, 0.995); });
      careful(mesh, [&] { modeling::relax(mesh, recipe.solid, 0.2 * mm, 1, 0, 0.4); });
    }
  }
  careful(mesh, [&] { modeling::project(mesh, recipe.solid, 0.1 * mm, 2); });
  round_vertices(mesh);
  return mesh;
}

void make_mesh(const eigengrasp::shapes::ShapeRecipe& recipe, const fs::path& folder) {
  const TriangleMesh mesh = surface_of(recipe);
  const modeling::MeshReport report = modeling::inspect(mesh);
  for (const std::string& sentence : modeling::problems(report, report.euler_characteristic))
    eigengrasp::fail("mesh {}: {}; a finer cell or thicker walls may help", recipe.name, sentence);
  modeling::save_obj(mesh, folder / (recipe.name + ".obj"), 6,
                     "Made by make_hand_meshes from shapes.yaml; metres.");
  fmt::print("{}: {} triangles, least quality {:.2f}\n", recipe.name, report.triangles, report.min_quality);
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
