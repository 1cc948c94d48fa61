// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// make_objects OUTPUT_DIR: writes the objects of data/objects as closed meshes in metres.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "designs.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/modeling/decimate.hpp"
#include "eigengrasp/modeling/mesh_tools.hpp"
#include "eigengrasp/modeling/polygonise.hpp"

namespace eigengrasp::make_objects {
namespace {

struct Design {
  std::string name;
  modeling::Solid (*solid)();
  double cell;            ///< of the grid [m]
  std::size_t triangles;  ///< at most
};

const std::vector<Design>& designs() {
  static const std::vector<Design> all{
      {"ashtray", ashtray, 1.4 * mm, 8000}, {"flask", flask, 1.3 * mm, 12000},
      {"glass", glass, 1.1 * mm, 12000},    {"phone", phone, 0.7 * mm, 15000},
      {"plane", plane, 0.8 * mm, 15000},    {"shoe", shoe, 1.4 * mm, 16000}};
  return all;
}

/// To the six decimals of the file, so that the checks see what a reader sees.
void round_vertices(TriangleMesh& mesh) {
  for (Vec3& p : mesh.vertices) p = (p * 1e6).array().round() * 1e-6;
}

TriangleMesh make_mesh(const Design& design) {
  const modeling::Solid solid = design.solid();
  modeling::PolygoniseOptions grid;
  grid.sharpen = false;  // the designs have no sharp edges
  TriangleMesh mesh = modeling::polygonise(solid, design.cell, grid);
  modeling::DecimateOptions options;
  options.max_edge = 12.0 * mm;
  options.min_quality = 0.25;
  // In two steps: what is a needle after the first is among the cheapest to collapse in the second.
  for (const double surplus : {1.06, 1.0}) {
    options.target_triangles = static_cast<std::size_t>(surplus * static_cast<double>(design.triangles));
    modeling::decimate(mesh, options);
    // Only where it is needed: evened out all over, vertices would leave the rims for the plains.
    for (int i = 0; i < 4; ++i) {
      modeling::flip_edges(mesh, 0.995);
      modeling::relax(mesh, solid, 1.0 * mm, 1, 0, 0.4);
    }
  }
  modeling::project(mesh, solid, 0.1 * mm, 2);
  round_vertices(mesh);
  return mesh;
}

/// True where the mesh is sound.
bool write_object(const Design& design, const std::filesystem::path& folder) {
  const TriangleMesh mesh = make_mesh(design);
  const modeling::MeshReport report = modeling::inspect(mesh);
  const Vec3 size = bounding_box(mesh).size() / mm;
  fmt::print(
      "{:8} {:6.1f} x {:5.1f} x {:5.1f} mm, {:5} triangles, {:7.2f} cm^3, Euler {}, least quality {:.2f}, "
      "longest edge {:.1f} mm\n",
      design.name, size.x(), size.y(), size.z(), report.triangles, report.volume * 1e6,
      report.euler_characteristic, report.min_quality, report.longest_edge / mm);
  const std::vector<std::string> found = modeling::problems(report);
  for (const std::string& sentence : found)
    fmt::print(stderr, "make_objects: {}: {}\n", design.name, sentence);
  modeling::save_obj(mesh, folder / (design.name + ".obj"), 6,
                     fmt::format("SPDX-License-Identifier: Apache-2.0\n"
                                 "# SPDX-FileCopyrightText: The eigengrasp authors\n"
                                 "# {}, in metres, made by tools/make_objects",
                                 design.name));
  return found.empty();
}

}  // namespace
}  // namespace eigengrasp::make_objects

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: make_objects OUTPUT_DIR [NAME...]\n");
    return 2;
  }
  try {
    bool sound = true;
    for (const auto& design : eigengrasp::make_objects::designs()) {
      bool wanted = argc == 2;
      for (int i = 2; i < argc; ++i) wanted = wanted || design.name == argv[i];
      if (wanted) sound = eigengrasp::make_objects::write_object(design, argv[1]) && sound;
    }
    return sound ? 0 : 1;
  } catch (const eigengrasp::Error& error) {
    fmt::print(stderr, "make_objects: {}\n", error.what());
    return 2;
  }
}
