// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/state_evaluator.hpp"

#include "core/variants.hpp"
#include "planning/kernel_workspace.hpp"
#include "planning/lane_state.hpp"
#include "planning/state_program.hpp"

namespace eigengrasp {

struct StateEvaluator::Storage {
  StateProgram program;
};

StateEvaluator::StateEvaluator(const CollisionModel& model, const EigengraspSpace& postures, double alpha,
                               InstructionSet instructions)
    : storage_(new Storage{{model, postures, alpha}}), functions_(&EIGENGRASP_VARIANT(kernel, instructions)) {
  storage_->program.add_posture_grid(postures, *functions_, model.options().threads);
}

StateEvaluator::~StateEvaluator() = default;
StateEvaluator::StateEvaluator(StateEvaluator&&) noexcept = default;

void StateEvaluator::evaluate(Batch& batch) const {
  functions_->evaluate(storage_->program.program(), batch.memory_->work());
}

StateEvaluator::Batch::Batch(const StateEvaluator& evaluator)
    : memory_(std::make_unique<KernelWorkspace>(evaluator.storage_->program.program())),
      n_amplitudes_(evaluator.storage_->program.program().n_amplitudes),
      n_contacts_(evaluator.storage_->program.program().n_contacts) {}

StateEvaluator::Batch::~Batch() = default;
StateEvaluator::Batch::Batch(Batch&&) noexcept = default;
StateEvaluator::Batch& StateEvaluator::Batch::operator=(Batch&&) noexcept = default;

void StateEvaluator::Batch::set(int lane, const HandState& state) {
  const kernel::Workspace& work = memory_->work();
  put_lane(state, lane, {work.position, work.quaternion, work.amplitudes});
}

HandState StateEvaluator::Batch::state(int lane) const {
  const kernel::Workspace& work = memory_->work();
  return take_lane(lane, {work.position, work.quaternion, work.amplitudes}, n_amplitudes_);
}

void StateEvaluator::Batch::set_threshold(int lane, double energy) {
  memory_->work().threshold[lane] = static_cast<float>(energy);
}

StateEvaluator::Verdict StateEvaluator::Batch::verdict(int lane) const {
  return static_cast<Verdict>(memory_->work().verdict[lane]);
}

double StateEvaluator::Batch::energy(int lane) const {
  return memory_->work().energy[lane];
}

void StateEvaluator::Batch::keep_approaches() {
  memory_->keep_approaches();
}

void StateEvaluator::Batch::approaches(int lane, std::vector<ContactApproach>& out) const {
  out.resize(static_cast<std::size_t>(n_contacts_));
  const float* kept = memory_->work().approaches + lane;
  for (ContactApproach& a : out) {
    const auto row = [&](int k) { return static_cast<double>(kept[k * kernel::n_lanes]); };
    a.p_OC = Vec3(row(0), row(1), row(2));
    a.n_OC = Vec3(row(3), row(4), row(5));
    a.distance = row(6);
    a.cosine = row(7);
    kept += kernel::n_approach_rows * kernel::n_lanes;
  }
}

}  // namespace eigengrasp
