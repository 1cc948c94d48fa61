// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/render/pictures.hpp"

namespace eigengrasp {

/// Draws a hand at an object, in small tiles of one grid.
class TilePainter {
 public:
  TilePainter(Scene scene, int threads);

  RenderScene add(const VecX& joints, const Pose& X_OH) const;
  /// A translucent hand.
  void add_ghost(RenderScene& scene, const VecX& joints, const Pose& X_OH) const;
  void add_contacts(RenderScene& scene, const Grasp& grasp) const;
  static std::vector<Vec3> contact_points(const Grasp& grasp);
  Image draw(const RenderScene& scene, const std::vector<Vec3>& framed, const Vec3& direction) const;

  const HandModel& hand() const { return *scene_.hand; }

 private:
  Scene scene_;
  DrawnHand hand_;
  SurfacePtr object_;
  Palette palette_;
  RenderOptions options_;
};

}  // namespace eigengrasp
