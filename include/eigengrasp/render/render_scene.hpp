// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "eigengrasp/core/pose.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "eigengrasp/render/camera.hpp"
#include "eigengrasp/render/image.hpp"

namespace eigengrasp {

/// A mesh that is ready to be drawn: smoothed normals and the hierarchy for rays. Immutable, shared by
/// scenes and threads.
class Surface;
using SurfacePtr = std::shared_ptr<const Surface>;

inline constexpr double kCreaseAngle = 40.0 * std::numbers::pi / 180.0;

/// Prepares a mesh. Triangles around a vertex share a normal where they meet at less than the crease angle
/// [rad], so that curved parts look smooth and edges stay sharp. Triangles may be turned either way. Cost:
/// about 1 us a triangle. @pre indices in range, finite vertices
SurfacePtr make_surface(const TriangleMesh& mesh, double crease_angle = kCreaseAngle);

/// A surface that stands in a scene.
struct RenderItem {
  SurfacePtr surface;
  Pose X_WM = Pose::Identity();  ///< of the mesh frame in the world
  Vec3 scale = Vec3::Ones();     ///< along the axes of the mesh frame, applied first
  Color color;                   ///< alpha below 1: translucent, casts no shadow
  /// Of several translucent items of one group, only the nearest surface is seen at each point.
  int group = -1;
  /// Share of the opacity that is left behind opaque items, in [0, 1]; above 0 the item counts as a marker
  /// and casts no shadow.
  double see_through = 0.0;
  /// Above 0: the item fades into the background at this distance [m] from fade_center_W.
  double fade_radius = 0.0;
  Vec3 fade_center_W = Vec3::Zero();
  bool shadow_only = false;  ///< is seen only where something shades it
  bool framed = true;        ///< counts when a camera is fitted to the scene
  double interest = 1.0;     ///< weight when a view is picked
};

/// Posed surfaces and markers.
class RenderScene {
 public:
  /// Adds a surface and returns its item, for further settings.
  RenderItem& add(SurfacePtr surface, const Pose& X_WM, const Color& color);
  /// The same after make_surface.
  RenderItem& add(const TriangleMesh& mesh, const Pose& X_WM, const Color& color);
  /// A ball, such as a contact point; seen faintly through what hides it.
  RenderItem& add_sphere(const Vec3& center_W, double radius, const Color& color);
  /// A translucent friction cone: apex, unit axis, friction coefficient, length along the axis [m].
  RenderItem& add_cone(const Vec3& apex_W, const Vec3& axis_W, double mu, double length, const Color& color);
  /// An arrow of a length [m] from a point along a unit direction; its thickness follows the length.
  void add_arrow(const Vec3& from_W, const Vec3& direction_W, double length, const Color& color);
  /// A level floor at height z that only shows shadows.
  void add_floor(double z, double radius);

  const std::vector<RenderItem>& items() const { return items_; }
  /// A number that no group of the scene has yet.
  int new_group() { return next_group_++; }
  /// Vertices of the framed items, in the world.
  std::vector<Vec3> framed_points() const;
  Box framed_box() const;

 private:
  std::vector<RenderItem> items_;
  int next_group_ = 0;
};

struct RenderOptions {
  int width = 400;   ///< [pixel]
  int height = 400;  ///< [pixel]
  int threads = 0;   ///< 0: all. Does not change the picture
  Color background{1.0F, 1.0F, 1.0F, 1.0F};
  double outline = 0.5;    ///< darkness of the lines along silhouettes, in [0, 1]
  double depth_cue = 0.1;  ///< share of the background in the furthest surface, in [0, 1]
};

/// Draws a scene: a key light from the upper left of the camera with a soft shadow, a fill light and an
/// ambient light with ambient occlusion; 16 samples a pixel. Deterministic. Cost: about 1 us a pixel and
/// core.
/// @throws Error where a side of the picture is below 1 or above 16384 pixels.
Image render(const RenderScene& scene, const Camera& camera, const RenderOptions& options = {});

/// Picks the direction of view_candidates(up) from which the items (by their interest) and the points of
/// interest hide least behind each other. Cost: about 10 ms.
Vec3 pick_view(const RenderScene& scene, std::span<const Vec3> points_W, const Vec3& up);

}  // namespace eigengrasp
