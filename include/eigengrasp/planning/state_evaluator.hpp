// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "eigengrasp/core/instruction_set.hpp"
#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"

namespace eigengrasp {

namespace kernel {
struct Functions;
}
class KernelWorkspace;

/// The variables of the search: pose of the approach frame of the hand (its approach point, orientation of
/// the base) in the object frame, and amplitudes of eigengrasps.
struct HandState {
  Vec3 p_OA = Vec3::Zero();  ///< [m]
  Eigen::Quaterniond q_OA = Eigen::Quaterniond::Identity();
  VecX amplitudes;
};

/// Evaluates sixteen hand states at once, in single precision, with the vector instructions of the processor:
/// posture from amplitudes, eq. (2), forward kinematics, collision, contact energy, eqs. (6) and (7).
///
/// Collision: inner balls of the links against the distance fields of object and obstacles, and of the other
/// links. A state that is called illegal intrudes or comes near (see CollisionModel::Options::refuse_depth);
/// one that is called legal may intrude by less than 1 mm. So what is reported is checked exactly. Energy:
/// from the object's field, see its error; near the field's medial axis the direction to the object is that
/// of the field's gradient.
///
/// Immutable, shared by all threads; each has a Batch of its own. Same bits with every instruction set.
/// Cost with AVX-512: 0.5-2 us a state, the nearer to the object the more; no allocation.
class StateEvaluator {
 public:
  static constexpr int lanes = 16;

  enum class Verdict : std::int32_t { legal, hits_object, hits_itself, hits_obstacle, energy_too_high };

  /// Sixteen states with what is found out about them.
  class Batch {
   public:
    explicit Batch(const StateEvaluator& evaluator);
    ~Batch();
    Batch(Batch&&) noexcept;
    Batch& operator=(Batch&&) noexcept;

    void set(int lane, const HandState& state);
    HandState state(int lane) const;
    /// States of this energy and above need not be told legal or not: their verdict is energy_too_high, or
    /// the collision that was seen before. Infinity at first: every state is judged.
    void set_threshold(int lane, double energy);
    Verdict verdict(int lane) const;
    /// In the unit of GraspEnergy::contact_energy; for energy_too_high a lower bound, at or above the
    /// threshold.
    /// @pre verdict is legal or energy_too_high
    double energy(int lane) const;

    /// From now on evaluate() keeps the approaches of the virtual contacts.
    void keep_approaches();
    /// Approaches of all virtual contacts, in their order: GraspEnergy::approach by gradients, in single
    /// precision. @pre they are kept; verdict is not energy_too_high
    void approaches(int lane, std::vector<ContactApproach>& out) const;

   private:
    friend class StateEvaluator;
    friend class Annealer;
    std::unique_ptr<KernelWorkspace> memory_;
    int n_amplitudes_;
    int n_contacts_;
  };

  /// @param alpha length [m] of eq. (6). @pre the model was prepared with Options::fast
  StateEvaluator(const CollisionModel& model, const EigengraspSpace& postures, double alpha,
                 InstructionSet instructions = best_instruction_set());
  ~StateEvaluator();
  StateEvaluator(StateEvaluator&&) noexcept;

  void evaluate(Batch& batch) const;

 private:
  friend class Annealer;
  struct Storage;
  std::unique_ptr<Storage> storage_;
  const kernel::Functions* functions_;
};

}  // namespace eigengrasp
