// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/geometry/point_cloud.hpp"
#include "eigengrasp/scan/mirror_plane.hpp"
#include "eigengrasp/scan/table_plane.hpp"

namespace eigengrasp {

/// How the space behind the surface seen is treated.
enum class UnseenSpace {
  mirrored,  ///< holds the mirror image of what is seen, about the plane of find_mirror_plane
  unknown,   ///< belongs to the object, as deep as its deepest point seen or as it is wide: no finger enters
  free       ///< is empty, but for a wall behind the surface
};

/// "mirrored", "unknown" or "free". @throws Error for another name
UnseenSpace parse_unseen_space(const std::string& name);
const char* to_string(UnseenSpace unseen);

struct ScanOptions {
  /// None: mirrored for one view, unknown for several, which as a rule see all sides.
  std::optional<UnseenSpace> unseen = {};
  std::optional<Vec3> up = {};  ///< against gravity, if known; of mirror planes. A table found wins over it
  bool remove_table = false;    ///< find the table, drop it, and let nothing reach below it
  double cell = 0.0;    ///< of the surface made [m]; 0: the spacing of the points, but 1/80 of the size
  double wall = 0.004;  ///< of UnseenSpace::free [m]
  std::size_t triangles = 6000;  ///< about as many at most
  int threads = 0;               ///< 0: all; the surface does not depend on it
};

/// A closed surface made of scans, and how.
struct ScanSurface {
  TriangleMesh mesh;  ///< closed, outward, one piece; in the frame of the clouds [m]
  UnseenSpace unseen = UnseenSpace::mirrored;
  std::optional<MirrorPlane> mirror;  ///< of the unseen side; none: it was treated as unknown
  std::optional<TablePlane> table;
  std::vector<Vec3> viewpoints;  ///< of each view [m]
  std::vector<bool> viewpoint_guessed;
  std::size_t points = 0;   ///< of the object
  double spacing = 0.0;     ///< [m]
  std::vector<bool> seen;   ///< of each triangle: whether it lies on what a view saw
  double seen_share = 0.0;  ///< of the surface's area that a view saw
};

/// The largest solid that agrees with what the views saw, less what UnseenSpace takes away, as a surface.
/// @param views clouds of one object in one frame, each seen from one viewpoint (estimated where not given)
/// @throws Error for less than 50 points, points in a plane or on a line (nothing to hold on to), an object
/// above 5 m (wrong units, as a rule) or below 2 mm, viewpoints within the object, or views that contradict
/// each other so much that nothing is left. Cost: 0.2-1 s of a core.
ScanSurface make_scan_surface(const std::vector<PointCloud>& views, const ScanOptions& options = {});

/// The part of the surface that was seen: open, without the guess behind it.
TriangleMesh seen_part(const ScanSurface& surface);

/// The surface as an object that knows what of it was seen (ObjectModel::seen). @throws as make_object
ObjectModel make_scanned_object(std::string name, const ScanSurface& surface);

}  // namespace eigengrasp
