// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/report/model_glb.hpp"

#include "glb_scene.hpp"

namespace eigengrasp {

std::string hand_glb(const HandModel& hand) {
  GlbScene glb;
  for (const HandLink& link : hand.links) glb.add(link.mesh, link.name, Pose::Identity(), GlbLook::hand);
  return glb.bytes("hand", Pose::Identity());
}

std::string object_glb(const ObjectModel& object) {
  GlbScene glb;
  glb.add(object.mesh, "object", Pose::Identity(), GlbLook::object);
  return glb.bytes("scene", Pose::Identity());
}

}  // namespace eigengrasp
