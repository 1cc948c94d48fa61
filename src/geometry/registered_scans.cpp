// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/registered_scans.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

constexpr double sensor_distance = 1.0;  // [m]

/// The pose of a scan, from the numbers behind its name.
Pose read_pose(TextLines& lines, double scale) {
  Vec3 t;
  for (double& x : t) x = scale * lines.number("a coordinate of the scan's translation");
  Eigen::Vector4d xyzw;
  for (double& x : xyzw) x = lines.number("a component of the scan's quaternion");
  if (std::abs(xyzw.norm() - 1.0) > 0.01)
    lines.fail_here("the quaternion has the length {:.3g}, expected 1; mend the line", xyzw.norm());
  Pose X = Pose::Identity();
  X.linear() = Eigen::Quaterniond(xyzw).normalized().conjugate().toRotationMatrix();
  X.translation() = t;
  return X;
}

PointCloud placed(PointCloud cloud, const Pose& X) {
  for (Vec3& p : cloud.points) p = X * p;
  cloud.viewpoint = X * (sensor_distance * Vec3::UnitZ());
  return cloud;
}

}  // namespace

bool is_registered_scans_file(const std::filesystem::path& file) {
  return file.extension() == ".conf";
}

RegisteredScans load_registered_scans(const std::filesystem::path& file, double scale) {
  const std::string content = read_text_file(file);
  TextLines lines(file, content);
  RegisteredScans scans;
  while (lines.next()) {
    const std::string_view keyword = lines.word();
    if (keyword == "camera") continue;
    if (keyword != "bmesh")
      lines.fail_here(
          "found \"{}\", expected bmesh or camera; mend the line, or name clouds of points instead",
          TextLines::shown(keyword));
    const std::filesystem::path name{std::string(lines.word())};
    if (name.empty()) lines.fail_here("the line ends where the file of a scan was expected; mend the line");
    const Pose X = read_pose(lines, scale);
    const std::filesystem::path scan = file.parent_path() / name;
    std::error_code ec;
    if (!std::filesystem::exists(scan, ec)) {
      scans.missing.push_back(name.string());
      continue;
    }
    scans.views.push_back(placed(load_point_cloud(scan, scale), X));
    scans.names.push_back(name.stem().string());
  }
  if (scans.views.empty())
    fail("{}: lists {} scans, none of which is there, expected them beside it; check the folder",
         file.string(), scans.missing.size());
  return scans;
}

std::vector<PointCloud> load_views(const std::filesystem::path& file, double scale) {
  if (is_registered_scans_file(file)) return load_registered_scans(file, scale).views;
  return {load_point_cloud(file, scale)};
}

}  // namespace eigengrasp
