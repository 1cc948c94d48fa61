// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/object_checks.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp::cli {

namespace {

struct ObjectChoice {
  std::string object;
  ObjectReadOptions options;
};

void print_object(const ObjectChoice& choice) {
  const ObjectModel object = load_sound_object(find_object(choice.object), choice.options);
  const MeshReport r = inspect_mesh(object.mesh);
  const Vec3 size = 1000.0 * r.box.size();
  fmt::print("{}: {} triangles, {} vertices\n", object.name, object.mesh.triangles.size(),
             object.mesh.vertices.size());
  fmt::print("size            {:.1f} x {:.1f} x {:.1f} mm\n", size.x(), size.y(), size.z());
  fmt::print("watertight      {}\n", r.watertight
                                         ? "yes"
                                         : fmt::format("no ({} boundary edges, {} non-manifold edges)",
                                                       r.boundary_edges, r.non_manifold_edges));
  fmt::print("components      {}\n", r.components);
  fmt::print("area            {:.2f} cm^2\n", 1e4 * r.area);
  fmt::print("volume          {:.2f} cm^3{}\n", 1e6 * r.volume, r.solid() ? "" : " (not a sound solid)");
  const Vec3 c = 1000.0 * object.center_of_mass;
  fmt::print("centre of mass  {:.2f} {:.2f} {:.2f} mm ({})\n", c.x(), c.y(), c.z(),
             r.solid() ? "of the volume" : "of the surface");
  fmt::print("largest radius  {:.2f} mm\n", 1000.0 * object.max_radius);
  if (r.degenerate_triangles > 0) fmt::print("{} triangles have no area\n", r.degenerate_triangles);
  constexpr double usual_hand = 0.2;  // [m]
  for (const std::string& s : size_warnings(r, usual_hand)) fmt::print("warning: {}\n", s);
}

}  // namespace

void add_object_command(CLI::App& app) {
  CLI::App* object = app.add_subcommand("object", "List shipped objects; report on a mesh");
  object->require_subcommand(1);
  object->footer("Examples:\n  eigengrasp object list\n  eigengrasp object info part.stl --units mm");
  CLI::App* list = object->add_subcommand("list", "Shipped objects");
  list->footer("Example:\n  eigengrasp object list");
  list->callback([] {
    for (const NamedModel& m : list_objects()) fmt::print("{:12} {}\n", m.name, m.path.string());
  });
  auto choice = std::make_shared<ObjectChoice>();
  CLI::App* info = object->add_subcommand("info", "Watertightness, components, volume, centre of mass, size");
  info->add_option("object", choice->object, "Mesh file, GraspIt! body, or a shipped object's name")
      ->required();
  info->add_option("--units", choice->options.units, "m, cm, mm, in (GraspIt! files: mm, else m)");
  info->add_option("--scale", choice->options.scale, "Makes the object this many times larger");
  info->footer("Example:\n  eigengrasp object info part.stl --units mm");
  info->callback([choice] { print_object(*choice); });
}

}  // namespace eigengrasp::cli
