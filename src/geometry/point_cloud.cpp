// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/point_cloud.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "geometry/mesh_file_checks.hpp"
#include "geometry/point_file_readers.hpp"
#include "geometry/point_tree.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

constexpr double kMaxReach = 1e6;  // [m], as for meshes

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

PointCloud read_by_kind(const std::filesystem::path& file, std::string_view content) {
  const std::string ending = ending_of(file);
  if (ending == ".pcd") return read_pcd_points(file, content);
  if (ending == ".obj") return read_obj_points(file, content);
  if (ending == ".ply") return read_ply_points(file, content);
  fail("{}: ends in \"{}\", expected a cloud of points as .ply, .pcd or .obj", file.string(), ending);
}

bool has_obj_face(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  while (lines.next())
    if (lines.word() == "f") return true;
  return false;
}

}  // namespace

PointCloud read_obj_points(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  PointCloud cloud;
  while (lines.next()) {
    if (lines.word() != "v") continue;
    Vec3& p = cloud.points.emplace_back();
    for (double& x : p) x = lines.number_or_nan("a coordinate");
  }
  return cloud;
}

PointCloud load_point_cloud(const std::filesystem::path& file, double scale) {
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec))
    fail("{}: there is no such file, expected a cloud of points; check the path", file.string());
  if (std::filesystem::file_size(file, ec) > kMaxFileBytes)
    fail("{}: has more than {} MB; thin the cloud", file.string(), kMaxFileBytes >> 20);
  PointCloud cloud = read_by_kind(file, read_text_file(file));
  const std::size_t all = cloud.points.size();
  std::erase_if(cloud.points, [](const Vec3& p) { return !p.allFinite(); });
  cloud.dropped = all - cloud.points.size();
  if (cloud.points.empty())
    fail("{}: has no point with finite coordinates ({} in all); save the cloud again", file.string(), all);
  for (Vec3& p : cloud.points) {
    p *= scale;
    if (!(p.cwiseAbs().maxCoeff() <= kMaxReach))
      fail("{}: reaches {:.3g} m from its origin, expected at most 1000 km; check the units", file.string(),
           p.cwiseAbs().maxCoeff());
  }
  if (cloud.viewpoint) *cloud.viewpoint *= scale;
  return cloud;
}

bool is_point_cloud_file(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".pcd") return true;
  if (ending != ".ply" && ending != ".obj") return false;
  try {
    const std::string content = read_text_file(file);
    return ending == ".ply" ? ply_has_no_faces(file, content) : !has_obj_face(file, content);
  } catch (const Error&) {
    return false;
  }
}

double point_spacing(const std::vector<Vec3>& points) {
  const PointTree tree(points);
  Box box;
  for (const Vec3& p : points) box.add(p);
  if (!(box.diagonal() > 0.0)) return 0.0;
  const double start = box.diagonal() / std::sqrt(static_cast<double>(points.size()));
  std::vector<double> nearest;
  std::vector<int> found;
  const std::size_t step = std::max<std::size_t>(points.size() / 500, 1);
  for (std::size_t i = 0; i < points.size(); i += step) {
    double best = 0.0;
    for (double radius = start; best == 0.0 && radius <= 2.0 * box.diagonal(); radius *= 2.0) {
      tree.find_in({points[i], radius}, found);
      for (const int place : found) {
        const double d = (tree.point(place) - points[i]).norm();
        if (tree.original(place) != static_cast<int>(i) && d > 0.0 && (best == 0.0 || d < best)) best = d;
      }
    }
    if (best > 0.0) nearest.push_back(best);
  }
  if (nearest.empty()) return 0.0;
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

}  // namespace eigengrasp
