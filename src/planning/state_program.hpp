// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/collision_model.hpp"
#include "planning/ball_packs.hpp"

namespace eigengrasp {

/// Owns what a kernel::Program points to. Neither copied nor moved.
class StateProgram {
 public:
  /// @pre the model was prepared with Options::fast
  StateProgram(const CollisionModel& model, const EigengraspSpace& postures, double alpha);
  StateProgram(const StateProgram&) = delete;
  StateProgram& operator=(const StateProgram&) = delete;

  /// For one or two amplitudes: computes the clearance of the hand from itself on a grid of postures.
  void add_posture_grid(const EigengraspSpace& postures, const kernel::Functions& functions, int threads);

  const kernel::Program& program() const { return program_; }

 private:
  void add_postures(const HandModel& hand, const EigengraspSpace& postures);
  void add_bodies(const HandModel& hand);
  void add_part(const CollisionModel& model, int link);
  void add_balls(const HandSurfaces::LinkSurface& surface, const Pose& X_BL, kernel::Part& part);
  void add_pairs(const HandModel& hand);
  void add_contacts(const HandModel& hand);
  kernel::FieldView view(const DistanceField& field);

  kernel::Program program_{};
  std::vector<float> origin_, basis_, dof_min_, dof_max_;
  std::vector<int> body_of_link_;
  std::vector<Pose> X_BL_;  ///< of each link, in the frame of its body
  std::vector<int> part_of_link_;
  std::vector<kernel::Body> bodies_;
  std::vector<kernel::Part> parts_;
  BallPacks packs_;
  std::vector<kernel::Pair> pairs_;
  std::vector<kernel::Contact> contacts_;
  std::vector<kernel::Solid> obstacles_;
  std::vector<std::vector<std::int32_t>> field_words_;
  std::vector<float> posture_clearance_;
};

}  // namespace eigengrasp
