// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/object_io.hpp"

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/geometry/point_cloud.hpp"
#include "eigengrasp/geometry/registered_scans.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "eigengrasp/scan/scan_surface.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// Scales that share a distance field: its cells and margins are made for the object at scale 1.
bool shares_field(double scale) {
  return scale >= 0.5 && scale <= 2.0;
}

/// One view or several, with the defaults of make_scan_surface.
ObjectModel load_scan(const std::filesystem::path& file, double scale) {
  const std::vector<PointCloud> views = load_views(file, scale);
  try {
    return make_scanned_object(file.stem().string(), make_scan_surface(views));
  } catch (const Error& e) {
    fail("{}: {}", file.string(), e.what());
  }
}

ObjectModel load_by_kind(const std::filesystem::path& file, const ObjectReadOptions& options) {
  const std::string ending = lower_extension(file.string());
  const bool inventor = ending == ".iv" || ending == ".wrl" || ending == ".vrml";
  const bool graspit = ending == ".xml";
  const std::string units = !options.units.empty() ? options.units : inventor || graspit ? "mm" : "m";
  const double scale = unit_length(units) * (shares_field(options.scale) ? 1.0 : options.scale);
  if (graspit) return load_graspit_body(file, scale);
  if (inventor) return make_object(file.stem().string(), load_inventor(file, scale));
  if (is_point_cloud_file(file) || is_registered_scans_file(file)) return load_scan(file, scale);
  if (is_mesh_file(file))
    return make_object(file.stem().string(),
                       load_mesh(file, {.scale = scale, .later_scale = options.later_scale}));
  fail(
      "{}: ends in \"{}\", expected a mesh (such as .obj, .stl, .ply, .off, .glb), .iv, .wrl, a GraspIt! "
      ".xml, a cloud of points (.ply, .pcd) or a list of range scans (.conf)",
      file.string(), ending);
}

}  // namespace

ObjectModel load_object(const std::filesystem::path& file, const ObjectReadOptions& options) {
  std::error_code ec;
  if (!std::filesystem::exists(file, ec))
    fail("{}: does not exist, expected a file of an object", file.string());
  if (!std::isfinite(options.scale) || options.scale <= 0.0) {
    fail("the scale is {}, expected a positive number", options.scale);
  }
  ObjectModel object = load_by_kind(file, options);
  if (shares_field(options.scale) && options.scale != 1.0) object = rescaled(object, options.scale);
  object.source = file;
  if (!options.name.empty()) object.name = options.name;
  if (!options.material.empty()) object.material = options.material;
  return object;
}

}  // namespace eigengrasp
