// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/scan/scan_surface.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/modeling/decimate.hpp"
#include "eigengrasp/modeling/polygonise.hpp"
#include "eigengrasp/scan/depth_view.hpp"
#include "eigengrasp/scan/viewpoint.hpp"
#include "scan/largest_piece.hpp"

namespace eigengrasp {

namespace {

constexpr std::size_t kLeastPoints = 50;
constexpr double kLargest = 5.0, kSmallest = 0.002;  // [m]
constexpr double kCellsAcross = 80.0;

/// What all views say together.
struct Views {
  std::vector<DepthView> views;
  std::vector<Vec3> points;  ///< of all
  Box box;                   ///< of the points

  double outside(const Vec3& p) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const DepthView& view : views) most = std::max(most, view.outside(p));
    return most;
  }
  Vec3 direction() const {
    Vec3 sum = Vec3::Zero();
    for (const DepthView& view : views) sum += view.direction();
    return sum.norm() > 1e-3 ? Vec3(sum.normalized()) : views.front().direction();
  }
};

void check_count(const std::vector<Vec3>& points) {
  if (points.size() < kLeastPoints)
    fail("the cloud has {} points of the object, expected at least {}; scan it again, nearer or finer",
         points.size(), kLeastPoints);
}

void check_size(const std::vector<Vec3>& points, double spacing) {
  Box box;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) {
    box.add(p);
    mean += p / static_cast<double>(points.size());
  }
  if (box.diagonal() > kLargest)
    fail(
        "the cloud is {:.3g} m across, expected an object of at most {:.0f} m; if it is in millimetres, say "
        "--units mm; if a table or a room is in it, say --remove-table or cut it out",
        box.diagonal(), kLargest);
  if (box.diagonal() < kSmallest)
    fail("the cloud is {:.3g} mm across, expected an object of at least {:.0f} mm; check the units",
         1e3 * box.diagonal(), 1e3 * kSmallest);
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points)
    covariance += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
  const Vec3 variances = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvalues();
  const double thickness = std::sqrt(std::max(variances[0], 0.0));
  if (std::sqrt(std::max(variances[1], 0.0)) < 0.5 * spacing)
    fail("all points lie on a line, expected a surface; check the columns of the file");
  if (thickness < 0.004 * box.diagonal())
    fail(
        "all points lie in a plane ({:.2g} mm off it), so the cloud does not tell how thick the object is; "
        "scan it from another side, or remove the table (--remove-table)",
        1e3 * thickness);
}

/// Views of the object alone.
Views make_views(const std::vector<PointCloud>& clouds, const ScanOptions& options, ScanSurface& result) {
  std::vector<std::vector<Vec3>> parts;
  Views views;
  for (const PointCloud& cloud : clouds) {
    parts.push_back(cloud.points);
    views.points.insert(views.points.end(), cloud.points.begin(), cloud.points.end());
  }
  check_count(views.points);
  result.spacing = 0.0;
  for (const auto& part : parts)
    result.spacing = std::max(result.spacing, part.size() > 1 ? point_spacing(part) : 0.0);
  if (!(result.spacing > 0.0))
    fail("all points of the cloud are one and the same, expected a surface; scan the object again");
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    if (parts[i].size() < 3) fail("view {} has {} points, expected at least 3", i + 1, parts[i].size());
    result.viewpoint_guessed.push_back(!clouds[i].viewpoint.has_value());
    result.viewpoints.push_back(clouds[i].viewpoint ? *clouds[i].viewpoint
                                                    : estimate_viewpoint(parts[i], result.spacing));
  }
  if (options.remove_table) {
    const double tolerance = std::max(0.004, result.spacing);
    result.table = find_table(views.points, result.viewpoints.front(), tolerance);
    if (!result.table)
      fail(
          "no table was found: no plane holds a fifth of the {} points with things above it; leave out "
          "--remove-table where the object is alone",
          views.points.size());
    views.points.clear();
    for (auto& part : parts) {
      part = object_above(*result.table, part, 1.5 * tolerance, std::max(0.01, 3.0 * result.spacing));
      views.points.insert(views.points.end(), part.begin(), part.end());
    }
  }
  check_count(views.points);  // the table may have been most of them
  check_size(views.points, result.spacing);
  for (const Vec3& p : views.points) views.box.add(p);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    for (const Vec3& p : parts[i])
      if ((p - result.viewpoints[i]).norm() < 2.0 * result.spacing)
        fail(
            "view {} has a point at its viewpoint, expected a sensor away from the object; say where it "
            "stood (--camera)",
            i + 1);
    views.views.emplace_back(parts[i], result.viewpoints[i], result.spacing);
  }
  result.points = views.points.size();
  return views;
}

/// Behind what a view can know: as deep as its deepest point, but the width of the object at least.
double too_deep(const Views& views, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const DepthView& view : views.views) {
    const double limit = std::max(view.deepest_depth(), view.nearest_depth() + view.width());
    least = std::min(least, view.depth(p) - limit);
  }
  return least;
}

modeling::Solid make_solid(const Views& views, const ScanSurface& surface, const ScanOptions& options,
                           double cell) {
  modeling::Solid solid;
  solid.box = views.box;
  if (surface.mirror)
    for (const Vec3& p : views.points) solid.box.add(surface.mirror->mirrored(p));
  double margin = 4.0 * cell;
  if (!surface.mirror && surface.unseen != UnseenSpace::free)
    for (const DepthView& view : views.views) margin = std::max(margin, view.width() + 4.0 * cell);
  if (surface.unseen == UnseenSpace::free) margin += options.wall;
  solid.box.min -= Vec3::Constant(margin);
  solid.box.max += Vec3::Constant(margin);
  const Box inner{solid.box.min + Vec3::Constant(2.0 * cell), solid.box.max - Vec3::Constant(2.0 * cell)};
  solid.distance = [&views, &surface, inner, wall = options.wall](const Vec3& p) {
    double d = views.outside(p);
    d = std::max(d, (inner.min - p).maxCoeff());
    d = std::max(d, (p - inner.max).maxCoeff());
    if (surface.table) d = std::max(d, -surface.table->above(p));
    if (surface.mirror) {
      d = std::max(d, views.outside(surface.mirror->mirrored(p)));
    } else if (surface.unseen == UnseenSpace::free) {
      double behind = std::numeric_limits<double>::infinity();
      for (const DepthView& view : views.views) behind = std::min(behind, view.behind(p));
      d = std::max(d, behind - wall);
    } else {
      d = std::max(d, too_deep(views, p));
    }
    return d;
  };
  return solid;
}

/// Tells the triangles that lie on what a view saw from the others, and their share of the area.
void find_seen(ScanSurface& surface, const Views& views, double tolerance) {
  const TriangleMesh& mesh = surface.mesh;
  double seen = 0.0, all = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    const Vec3 n = area_normal(mesh, t);
    surface.seen.push_back(std::any_of(views.views.begin(), views.views.end(), [&](const DepthView& view) {
      return std::abs(view.behind(middle)) <= tolerance && n.dot(middle - view.viewpoint()) <= 0.0;
    }));
    all += n.norm();
    if (surface.seen.back()) seen += n.norm();
  }
  surface.seen_share = all > 0.0 ? seen / all : 0.0;
}

}  // namespace

UnseenSpace parse_unseen_space(const std::string& name) {
  for (const UnseenSpace unseen : {UnseenSpace::mirrored, UnseenSpace::unknown, UnseenSpace::free})
    if (name == to_string(unseen)) return unseen;
  fail("unseen space is \"{}\", expected mirrored, unknown or free", name);
}

const char* to_string(UnseenSpace unseen) {
  switch (unseen) {
    case UnseenSpace::mirrored:
      return "mirrored";
    case UnseenSpace::unknown:
      return "unknown";
    default:
      return "free";
  }
}

ScanSurface make_scan_surface(const std::vector<PointCloud>& clouds, const ScanOptions& options) {
  if (clouds.empty()) fail("there is no view, expected at least one cloud of points");
  ScanSurface result;
  const Views views = make_views(clouds, options, result);
  const double cell =
      options.cell > 0.0 ? options.cell : std::max(result.spacing, views.box.diagonal() / kCellsAcross);
  if (views.box.diagonal() / cell > 400.0)
    fail("cells of {:.3g} mm are too small for a cloud {:.3g} m across, expected at least {:.3g} mm",
         1e3 * cell, views.box.diagonal(), views.box.diagonal() / 0.4);
  result.unseen =
      options.unseen.value_or(views.views.size() > 1 ? UnseenSpace::unknown : UnseenSpace::mirrored);
  if (result.unseen == UnseenSpace::mirrored)
    result.mirror = find_mirror_plane(
        views.points, [&](const Vec3& p) { return views.outside(p); }, views.direction(),
        std::max(2.0 * result.spacing, 0.5 * cell),
        result.table ? std::optional<Vec3>(result.table->normal) : options.up);
  const modeling::Solid solid = make_solid(views, result, options, cell);
  modeling::PolygoniseOptions polygonise;
  polygonise.n_threads = options.threads;
  polygonise.relax_iterations = 1;
  polygonise.sharpen = false;  // noise has no edges
  try {
    result.mesh = modeling::polygonise(solid, cell, polygonise);
  } catch (const std::logic_error&) {
    fail(
        "nothing is left of the object: the views contradict each other, or the wall is thinner than the "
        "cells of {:.2g} mm; check that all clouds are in one frame and where the sensors stood (--camera)",
        1e3 * cell);
  }
  keep_largest_piece(result.mesh);
  modeling::DecimateOptions decimate;
  decimate.target_triangles = options.triangles;
  modeling::decimate(result.mesh, decimate);
  weld(result.mesh, 0.0);
  find_seen(result, views, std::max(1.5 * cell, 2.0 * result.spacing));
  return result;
}

TriangleMesh seen_part(const ScanSurface& surface) {
  TriangleMesh part = surface.mesh;
  part.triangles.clear();
  for (std::size_t t = 0; t < surface.seen.size(); ++t)
    if (surface.seen[t]) part.triangles.push_back(surface.mesh.triangles[t]);
  weld(part, 0.0);  // drops what no triangle uses
  return part;
}

ObjectModel make_scanned_object(std::string name, const ScanSurface& surface) {
  ObjectModel object = make_object(std::move(name), surface.mesh);
  TriangleMesh seen = seen_part(surface);
  if (!seen.triangles.empty()) object.seen = std::make_shared<const TriangleMesh>(std::move(seen));
  return object;
}

}  // namespace eigengrasp
