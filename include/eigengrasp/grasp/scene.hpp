// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Something that the hand must not touch.
struct Obstacle {
  std::shared_ptr<const ObjectModel> model;
  Pose X_OB = Pose::Identity();  ///< of the obstacle's frame in the object's frame
};

/// What a grasp is planned in. Everything is posed in the object frame O. Immutable, shared by all threads.
struct Scene {
  std::shared_ptr<const HandModel> hand;
  std::shared_ptr<const ObjectModel> object;
  std::vector<Obstacle> obstacles;
  Material object_material;  ///< name from the object, friction where the user gave one
};

/// A table: a box of side 2 m and thickness 50 mm with its top at height z [m] of the object frame.
Obstacle make_table(double z);

/// Gives every contact of the hand this Coulomb coefficient, instead of the materials'. @pre friction >= 0
void set_friction(Scene& scene, double friction);

/// Radius [m] of the ball about the base frame that holds the hand in its open (rest) posture.
double hand_reach(const HandModel& hand);

}  // namespace eigengrasp
