// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/online_job.hpp"

#include <algorithm>
#include <exception>
#include <thread>

#include "eigengrasp/wire/message_makers.hpp"
#include "server/thread_priority.hpp"

namespace eigengrasp::server {

namespace {

constexpr auto kFrame = std::chrono::microseconds(16667);
constexpr auto kShortestFrame = std::chrono::milliseconds(4);  ///< however fast wrist poses come

bool is_wrist(const wire::ClientMessage& message) {
  return std::holds_alternative<wire::Wrist>(message);
}

}  // namespace

void OnlineJob::give(wire::ClientMessage message, Clock::time_point arrived) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= most_waiting) {
      const auto oldest = std::find_if(waiting_.begin(), waiting_.end(),
                                       [](const Input& input) { return is_wrist(input.message); });
      if (oldest == waiting_.end()) return;
      waiting_.erase(oldest);
    }
    waiting_.push_back({std::move(message), arrived});
  }
  changed_.notify_one();
}

void OnlineJob::stop(bool tell) {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    tell_ = tell;
  }
  changed_.notify_one();
}

std::optional<std::deque<OnlineJob::Input>> OnlineJob::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, time, [this] { return stopped_ || !waiting_.empty(); });
  if (stopped_) return {};
  return std::exchange(waiting_, {});
}

void OnlineJob::run() {
  const auto refuse = [this](wire::ErrorCode code, const char* sentence) {
    outlet_->refuse(code, sentence, wire::OnlineStart::type);
  };
  try {
    plan_online();
  } catch (const NotKnown& e) {
    refuse(wire::ErrorCode::not_known, e.what());
  } catch (const std::exception& e) {
    refuse(wire::ErrorCode::failed, e.what());
  }
  planner_.reset();
  bool tell = false;
  {
    const std::lock_guard lock(mutex_);
    tell = !stopped_ || tell_;
    stopped_ = true;
  }
  if (tell) outlet_->send(wire::OnlineStopped{session_});
}

void OnlineJob::plan_online() {
  const auto begin = Clock::now();
  model_ =
      services_.scenes.get({start_.hand, start_.object, start_.scale, start_.table, start_.options.friction});
  OnlineOptions options = wire::online_options(start_);
  options.amplitudes = std::min(options.amplitudes, model_->scene().hand->n_dof());
  make_planner(options);
  wire::OnlineReady ready{
      session_, start_.hand, start_.object, {}, std::chrono::duration<double>(Clock::now() - begin).count()};
  if (start_.table) ready.table_height = table_height(*model_->scene().object);
  outlet_->send(ready);
  auto shown = Clock::now() - kFrame;
  while (auto inputs = wait_until(shown + kFrame)) {
    if (Clock::now() < shown + kShortestFrame) {  // more may come until then
      std::this_thread::sleep_until(shown + kShortestFrame);
      auto more = wait_until(Clock::now());
      if (!more) return;
      std::move(more->begin(), more->end(), std::back_inserter(*inputs));
    }
    std::optional<Clock::time_point> wrist_arrived;
    for (const Input& input : *inputs) {
      take(input.message);
      if (is_wrist(input.message)) wrist_arrived = input.arrived;
    }
    shown = Clock::now();
    show(wrist_arrived);
  }
}

/// In a thread that gives way, so that the planner's threads do.
void OnlineJob::make_planner(const OnlineOptions& options) {
  std::exception_ptr failure;
  std::thread maker([&] {
    give_way();
    try {
      planner_ = std::make_unique<OnlinePlanner>(model_, options);
    } catch (...) {
      failure = std::current_exception();
    }
  });
  maker.join();
  if (failure) std::rethrow_exception(failure);
}

void OnlineJob::take(const wire::ClientMessage& message) {
  if (const auto* wrist = std::get_if<wire::Wrist>(&message)) planner_->set_wrist(wire::wrist_sample(*wrist));
  if (const auto* command = std::get_if<wire::Command>(&message)) close_hand(command->command);
  if (const auto* get = std::get_if<wire::SolutionGet>(&message)) answer(*get);
  const auto* targets = std::get_if<wire::Targets>(&message);
  if (targets == nullptr) return;
  try {
    planner_->set_targets(wire::variable_targets(*targets));
  } catch (const Error& e) {
    outlet_->refuse(wire::ErrorCode::bad_message, e.what(), wire::Targets::type);
  }
}

void OnlineJob::close_hand(OperatorCommand command) {
  const std::optional<Grasp> grasp = planner_->command(command);
  if (command != OperatorCommand::close) return;
  wire::Closed closed;
  if (!grasp) {
    closed.message = "The hand touches nothing here; move it up to the object, and close again.";
  } else if (grasp->form_closure) {
    closed.message =
        fmt::format("The grasp holds: epsilon {:.4f}, {} contacts.", grasp->epsilon, grasp->contacts.size());
  } else {
    closed.message = "The fingers closed, but the grasp does not hold every disturbance; open, and move on.";
  }
  if (grasp) closed.grasp = wire::grasp_shape(*model_->scene().hand, *grasp);
  outlet_->send(closed);
}

void OnlineJob::answer(const wire::SolutionGet& message) {
  wire::SolutionReply reply{message.id, {}};
  if (const auto grasp = planner_->solution(message.id))
    reply.grasp = wire::grasp_shape(*model_->scene().hand, *grasp);
  outlet_->send(reply);
}

void OnlineJob::show(std::optional<Clock::time_point> wrist_arrived) {
  const HandModel& hand = *model_->scene().hand;
  const OnlineView view = planner_->update();
  wire::View message = wire::view_message(hand, view);
  if (view.offer) {
    if (!offer_ || offer_->id != view.offer->id) {
      offer_.reset();
      if (const auto grasp = planner_->solution(view.offer->id))
        offer_ = wire::offer_shape(hand, view.offer->id, *grasp);
    }
    message.offer = offer_;
  }
  if (wrist_arrived)
    message.server_ms = std::chrono::duration<double, std::milli>(Clock::now() - *wrist_arrived).count();
  outlet_->send(message, Kind::view);
}

}  // namespace eigengrasp::server
