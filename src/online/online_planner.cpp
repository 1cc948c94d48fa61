// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/online/online_planner.hpp"

#include "eigengrasp/core/error.hpp"
#include "online/online_work.hpp"

namespace eigengrasp {

namespace {

std::shared_ptr<const CollisionModel> prepare(Scene scene, std::shared_ptr<PreparationCache> cache) {
  CollisionModel::Options options;
  options.cache = std::move(cache);
  return std::make_shared<const CollisionModel>(std::move(scene), options);
}

const OnlineOptions& sound(const OnlineOptions& options, const HandModel& hand) {
  const auto violations = options.validate(hand);
  if (violations.empty()) return options;
  std::string all = violations.front();
  for (std::size_t i = 1; i < violations.size(); ++i) all += "; " + violations[i];
  throw Error(all);
}

}  // namespace

OnlinePlanner::OnlinePlanner(Scene scene, const OnlineOptions& options,
                             std::shared_ptr<PreparationCache> cache)
    : OnlinePlanner(prepare((sound(options, *scene.hand), std::move(scene)), std::move(cache)), options) {}

OnlinePlanner::OnlinePlanner(const std::shared_ptr<const CollisionModel>& model, const OnlineOptions& options)
    : work_(std::make_unique<Work>(model, sound(options, *model->scene().hand))) {}

OnlinePlanner::~OnlinePlanner() = default;

WristTrack::Taken OnlinePlanner::set_wrist(const WristSample& sample) {
  return work_->set_wrist(sample);
}

void OnlinePlanner::set_targets(std::vector<VariableTarget> targets) {
  check_targets(targets, *scene().hand, options().amplitudes);
  work_->set_targets(std::move(targets));
}

std::optional<Grasp> OnlinePlanner::command(OperatorCommand command) {
  switch (command) {
    case OperatorCommand::close:
      return work_->close();
    case OperatorCommand::open:
      work_->open();
      break;
    case OperatorCommand::forget:
      work_->forget();
      break;
  }
  return std::nullopt;
}

OnlineView OnlinePlanner::update() {
  return work_->update();
}
std::optional<Grasp> OnlinePlanner::solution(std::uint64_t id) const {
  return work_->solution(id);
}
const Scene& OnlinePlanner::scene() const {
  return work_->scene();
}
const OnlineOptions& OnlinePlanner::options() const {
  return work_->options();
}

}  // namespace eigengrasp
