// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <limits>
#include <vector>

#include "surface.hpp"

namespace eigengrasp {

/// Rays that are traced together.
inline constexpr int kLanes = 16;

/// Where a ray meets a surface.
struct SurfaceHit {
  int item = -1;          ///< of the scene; -1: nothing, and the rest is not set
  float distance = 0.0F;  ///< in lengths of the ray's direction
  Vec3f normal;           ///< unit, smooth, towards the viewer
  Vec3f geometric;        ///< unit, of the triangle, towards the viewer
};

struct Rays {
  std::array<Vec3f, kLanes> origins;
  std::array<Vec3f, kLanes> directions;
  std::array<float, kLanes> near{};
  std::array<float, kLanes> far;
  std::array<bool, kLanes> active;

  Rays() {
    far.fill(std::numeric_limits<float>::infinity());
    active.fill(true);
  }
};

/// The items of a scene in two hierarchies: solid items, which hide and shade each other, and layers
/// (translucent items and markers).
class RayScene {
 public:
  explicit RayScene(const RenderScene& scene);

  const RenderItem& item(int i) const { return items_[static_cast<std::size_t>(i)]; }
  bool has_layers() const { return !layers_.indices.empty(); }

  /// Nearest hits of the active rays.
  void trace_solids(const Rays& rays, std::array<SurfaceHit, kLanes>& hits) const {
    trace(solids_, rays, hits);
  }
  void trace_layers(const Rays& rays, std::array<SurfaceHit, kLanes>& hits) const {
    trace(layers_, rays, hits);
  }
  /// Whether a solid item lies on the way of each active ray.
  std::array<bool, kLanes> occluded(const Rays& rays) const;

 private:
  struct Part {
    ScenePtr scene;
    std::vector<int> indices;  ///< of the items, by instance
  };
  void add(Part& part, int index) const;
  void trace(const Part& part, const Rays& rays, std::array<SurfaceHit, kLanes>& hits) const;
  SurfaceHit make_hit(int item, const RTCRayHit16& packet, int lane, const Vec3f& direction) const;

  struct Placement {
    Eigen::Matrix3f normal_turn;  ///< from normals of the mesh to the world
  };
  const std::vector<RenderItem>& items_;
  std::vector<Placement> placements_;
  Part solids_;
  Part layers_;
};

}  // namespace eigengrasp
