// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/plan_job.hpp"

#include "eigengrasp/wire/message_makers.hpp"
#include "server/thread_priority.hpp"

namespace eigengrasp::server {

void PlanJob::run() {
  give_way();
  const auto refuse = [this](wire::ErrorCode code, const char* sentence) {
    if (!abandoned_.load()) outlet_->refuse(code, sentence, wire::PlanStart::type);
  };
  try {
    plan();
  } catch (const NotKnown& e) {
    refuse(wire::ErrorCode::not_known, e.what());
  } catch (const std::exception& e) {
    refuse(wire::ErrorCode::failed, e.what());
  }
  ended_.store(true);
}

void PlanJob::plan() {
  PlanRecord record;
  record.id = id_;
  record.scale = start_.scale;
  record.model =
      services_.scenes.get({start_.hand, start_.object, start_.scale, start_.table, start_.options.friction});
  const HandModel& hand = *record.model->scene().hand;
  PlanOptions& options = record.options;
  options = wire::plan_options(start_);
  options.amplitudes = std::min(options.amplitudes, hand.n_dof());
  options.threads = services_.options.threads;
  send(wire::PlanStarted{id_, start_.hand, start_.object});
  PlanOptions watched = options;
  watched.stop = &stop_;
  watched.progress = [&](const PlanProgress& p) {
    wire::PlanProgressMessage message{id_, p.iterations, p.iterations_total, p.seconds, {}};
    if (p.best_energy != 0.0) message.best_energy = p.best_energy;
    send(message, Kind::progress);
  };
  watched.milestone = [&](const SearchMilestone& m) {
    send(wire::PlanMilestone{id_, m.iteration, m.energy, wire::posture_poses(hand, m.dofs, m.X_OH)},
         Kind::milestone);
  };
  record.result = plan_grasps(*record.model, watched);
  const auto message = wire::plan_result_message(id_, hand, record.result);
  services_.plans.add(std::move(record));
  send(message);
}

}  // namespace eigengrasp::server
