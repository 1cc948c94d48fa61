// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "model_io/graspit_xml.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// Scaled about the origin of the file, then moved by the offset, whose lengths are not scaled.
TriangleMesh read_geometry(const XmlElement& root, double unit) {
  const XmlElement geometry = root.require_child("geometryFile");
  const auto file = root.file().parent_path() / geometry.require_text();
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec)) {
    geometry.fail("<geometryFile> is \"{}\", but {} does not exist", shown(geometry.text()), file.string());
  }
  double scale = unit;
  if (const XmlElement scaling = root.child("geometryScaling")) {
    if (scaling.number() <= 0.0) {
      scaling.fail("<geometryScaling> is \"{}\", expected a positive number", shown(scaling.text()));
    }
    scale *= scaling.number();
  }
  const std::string ending = lower_extension(file.string());
  TriangleMesh mesh;
  if (ending == ".iv" || ending == ".wrl" || ending == ".vrml") {
    mesh = load_inventor(file, scale);
  } else if (is_mesh_file(file)) {
    mesh = load_mesh(file, {.scale = scale});
  } else {
    geometry.fail("<geometryFile> is \"{}\", expected a file of a known kind such as .iv, .wrl, .off or .stl",
                  shown(geometry.text()));
  }
  if (const XmlElement offset = root.child("geometryOffset")) {
    Pose X = read_graspit_transform(offset.require_child("transform"));
    X.translation() *= unit / metres_of_mm;
    transform(mesh, X);
  }
  return mesh;
}

}  // namespace

GraspitBody read_graspit_body(const std::filesystem::path& file, double unit, bool with_mesh) {
  const XmlFile xml(file);
  const XmlElement root = xml.require_root("root");
  GraspitBody body;
  const XmlElement material = root.child("material");
  body.material = material ? material.require_text() : "wood";
  if (const XmlElement youngs = root.child("youngs")) {
    body.youngs_modulus = youngs.number();
    if (*body.youngs_modulus <= 0.0) {
      youngs.fail("<youngs> is \"{}\", expected a positive number of Pa", shown(youngs.text()));
    }
  }
  if (const XmlElement mass = root.child("mass")) {
    body.mass = kilograms_of_g * mass.number();
    if (body.mass < 0.0) mass.fail("<mass> is \"{}\", expected a positive number of g", shown(mass.text()));
  }
  if (const XmlElement cog = root.child("cog")) body.center_of_mass = unit * cog.vector();
  if (with_mesh) body.mesh = read_geometry(root, unit);
  return body;
}

ObjectModel load_graspit_body(const std::filesystem::path& file, double unit) {
  GraspitBody body = read_graspit_body(file, unit, true);
  const Vec3 center = body.center_of_mass ? *body.center_of_mass : inspect_mesh(body.mesh).surface_center;
  ObjectModel object = make_object(file.stem().string(), std::move(body.mesh), &center);
  object.source = file;
  object.material = body.material;
  return object;
}

}  // namespace eigengrasp
