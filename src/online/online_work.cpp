// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/online_work.hpp"

#include <algorithm>

#include "eigengrasp/core/stop_watch.hpp"
#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {

constexpr int steps_at_a_time = 8;        // of all chains, between two looks at what has changed
constexpr double palm_approach = 0.030;   // [m], see test_pregrasp
constexpr double new_direction = 0.35;    // [rad] the wrist has turned: a new approach
constexpr double new_line = 0.05;         // [m] the wrist has moved sideways: a new approach
constexpr double ask_again = 0.05;        // [s] between two tests of the hand as it is shown
constexpr std::size_t tests_of_now = 4;   // of the shown hand, that its epsilon is the lowest of
constexpr std::size_t most_postures = 4;  // that "close" tries
constexpr double holds_well = 0.02;  // epsilon of the shown posture, above which it is not asked for others

PlanOptions energy_options(const OnlineOptions& options) {
  PlanOptions o;
  o.energy = EnergyKind::wrench;
  o.norm = options.norm;
  o.epsilon_min = options.epsilon_min;
  return o;
}

}  // namespace

OnlinePlanner::Work::Work(std::shared_ptr<const CollisionModel> model, const OnlineOptions& options)
    : model_(std::move(model)),
      options_(options),
      energy_(*model_, energy_options(options)),
      queue_(options.queue, distinctness_of(*model_->scene().hand)),
      solutions_(model_->scene(), options_),
      shown_(*model_, options_) {
  threads_.emplace_back([this] { search(); });
  for (int i = 0; i < options.test_threads; ++i) threads_.emplace_back([this] { test(); });
}

OnlinePlanner::Work::~Work() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  wake_search_.notify_all();
  wake_tests_.notify_all();
}

WristTrack::Taken OnlinePlanner::Work::set_wrist(const WristSample& sample) {
  const std::scoped_lock lock(mutex_);
  const WristTrack::Taken taken = track_.take(sample);
  if (taken != WristTrack::Taken::newest && taken != WristTrack::Taken::restarted) return taken;
  ++change_.wrist;
  const ApproachOffset moved = offset_from(*scene().hand, X_OW_approach_, sample.X_OH);
  if (phase_ == OnlinePhase::waiting || moved.angle > new_direction || moved.offset > new_line) {
    ++change_.approach;
    X_OW_approach_ = sample.X_OH;
    approach_began_ = seconds();
    rates_.time_to_first_grasp = 0.0;
    queue_.clear(true);
  }
  if (phase_ == OnlinePhase::waiting) phase_ = OnlinePhase::approach;
  wake_search_.notify_one();
  return taken;
}

void OnlinePlanner::Work::set_targets(std::vector<VariableTarget> targets) {
  const std::scoped_lock lock(mutex_);
  targets_ = std::move(targets);
  ++change_.targets;
  queue_.clear(true);
}

/// First stage.
void OnlinePlanner::Work::search() {
  const EigengraspSpace postures = scene().hand->eigengrasps.with_size(
      options_.amplitudes, scene().hand->dof_min(), scene().hand->dof_max());
  const StateEvaluator evaluator(*model_, postures, PlanOptions{}.alpha);
  ApproachSearch search({*model_, energy_, evaluator, options_});
  std::vector<PreGrasp> found;
  std::vector<VariableTarget> targets;
  Change done;
  StopWatch watch;
  while (true) {
    Change change;
    Pose X_OW;
    {
      std::unique_lock lock(mutex_);
      const std::int64_t postures_done = search.iterations() - rates_.postures;
      rates_.postures += postures_done;
      posture_rate_.add(postures_done, watch.lap());
      bool any = false;
      for (PreGrasp& p : found)
        if (done.approach == change_.approach && done.targets == change_.targets)
          any = queue_.add(std::move(p)) || any;
      if (any) wake_tests_.notify_one();
      cone_ = search.space().cone();
      wake_search_.wait(lock, [&] { return stop_ || phase_ == OnlinePhase::approach; });
      if (stop_) return;
      change = change_;
      if (change.wrist != done.wrist) X_OW = track_.newest()->X_OH;
      if (change.targets != done.targets) targets = targets_;
    }
    watch.lap();
    found.clear();
    take_up(change, done, X_OW, targets, search);
    for (int i = 0; i < steps_at_a_time; ++i) search.step(found);
  }
}

void OnlinePlanner::Work::take_up(const Change& change, Change& done, const Pose& X_OW,
                                  const std::vector<VariableTarget>& targets, ApproachSearch& search) const {
  if (change.approach != done.approach) {
    search.begin(X_OW);
  } else if (change.wrist != done.wrist) {
    search.follow(X_OW);
  }
  if (change.targets != done.targets) search.aim(targets);
  done = change;
}

/// Second stage.
void OnlinePlanner::Work::test() {
  while (true) {
    std::optional<PreGrasp> candidate;
    std::optional<NowRequest> now;
    {
      std::unique_lock lock(mutex_);
      wake_tests_.wait(lock, [&] {
        return stop_ || (phase_ == OnlinePhase::approach && (now_request_ || !queue_.empty()));
      });
      if (stop_) return;
      std::swap(now, now_request_);
      if (!now) candidate = queue_.take();
    }
    StopWatch watch;
    if (now) {
      const std::optional<Grasp> grasp = grasp_now(now->X_OH, {now->dofs});
      const std::scoped_lock lock(mutex_);
      epsilons_now_.push_back(grasp && grasp->form_closure ? grasp->epsilon : -1.0);
      if (epsilons_now_.size() > tests_of_now) epsilons_now_.pop_front();
    } else {
      const TestedPreGrasp tested = test_pregrasp(*model_, energy_, std::move(*candidate), {palm_approach});
      const std::scoped_lock lock(mutex_);
      ++rates_.candidates;
      candidate_rate_.add(1, watch.lap());
      if (tested.result.grasp.form_closure) keep(tested.result.grasp);
    }
  }
}

/// @pre mutex_ is held
void OnlinePlanner::Work::keep(const Grasp& found) {
  ++rates_.form_closed;
  const double now = seconds();
  solutions_.add(found, track_.newest()->X_OH, now);
  if (rates_.time_to_first_grasp == 0.0 && solutions_.any_in_reach(track_.newest()->X_OH))
    rates_.time_to_first_grasp = now - approach_began_;
}

/// The best that closing the hand at a wrist pose comes to, over some postures that are free there; none
/// where nothing is touched.
std::optional<Grasp> OnlinePlanner::Work::grasp_now(const Pose& X_OH,
                                                    const std::vector<VecX>& postures) const {
  std::optional<Grasp> best;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    PreGrasp p;
    p.X_OH = X_OH;
    p.dofs = postures[i];
    p.amplitudes = scene().hand->eigengrasps.project(p.dofs);
    const TestedPreGrasp tested = test_pregrasp(*model_, energy_, std::move(p), {});
    const Grasp& g = tested.result.grasp;
    if (tested.result.tests == 0 || g.contacts.empty()) continue;
    if (!best || (g.form_closure && g.epsilon > best->epsilon)) best = g;
    if (i == 0 && g.epsilon >= holds_well) break;  // what is shown is what is meant
  }
  return best;
}

/// Postures to close from: the one that is shown, then those of the solutions nearest to the wrist.
/// @pre mutex_ is held
std::vector<VecX> OnlinePlanner::Work::postures_to_close(const VecX& shown) const {
  std::vector<VecX> postures{shown};
  for (const OnlineSolution& s : solutions_.list(track_.newest()->X_OH, seconds()))
    if (postures.size() < most_postures) postures.push_back(solutions_.find(s.id)->pregrasp_dofs);
  return postures;
}

std::optional<Grasp> OnlinePlanner::Work::close() {
  const std::scoped_lock shown_lock(shown_mutex_);
  std::vector<VecX> postures;
  {
    const std::scoped_lock lock(mutex_);
    if (phase_ != OnlinePhase::approach) return std::nullopt;
    postures = postures_to_close(shown_.dofs());
  }
  std::optional<Grasp> grasp = grasp_now(shown_.X_OH(), postures);
  if (!grasp) return grasp;
  shown_.hold(*grasp);
  const std::scoped_lock lock(mutex_);
  phase_ = OnlinePhase::holding;
  held_ = grasp;
  return grasp;
}

void OnlinePlanner::Work::open() {
  const std::scoped_lock shown_lock(shown_mutex_);
  const std::scoped_lock lock(mutex_);
  if (phase_ != OnlinePhase::holding) return;
  shown_.let_go(*held_);
  held_.reset();
  epsilons_now_.clear();
  phase_ = OnlinePhase::approach;
  wake_search_.notify_one();
  wake_tests_.notify_all();
}

void OnlinePlanner::Work::forget() {
  const std::scoped_lock lock(mutex_);
  solutions_.clear();
  queue_.clear(true);
  rates_.time_to_first_grasp = 0.0;
  approach_began_ = seconds();
  ++change_.approach;
}

std::optional<Grasp> OnlinePlanner::Work::solution(std::uint64_t id) const {
  const std::scoped_lock lock(mutex_);
  const Grasp* grasp = solutions_.find(id);
  return grasp ? std::optional<Grasp>(*grasp) : std::nullopt;
}

/// @pre both mutexes are held
void OnlinePlanner::Work::ask_about_now(double now) {
  const bool near = solutions_.offered() && shown_.preshape() > 0.0;
  if (!near) {
    epsilons_now_.clear();
    return;
  }
  if (now - now_asked_ < ask_again) return;
  now_asked_ = now;
  now_request_ = NowRequest{shown_.X_OH(), shown_.dofs()};
  wake_tests_.notify_one();
}

OnlineView OnlinePlanner::Work::update() {
  const std::scoped_lock shown_lock(shown_mutex_);
  const double now = seconds();
  std::optional<Grasp> offered;
  Pose X_OW;
  OnlinePhase phase;
  {
    const std::scoped_lock lock(mutex_);
    phase = phase_;
    if (phase == OnlinePhase::approach) {
      X_OW = track_.newest()->X_OH;
      solutions_.update(X_OW, now);
      if (const Grasp* g = solutions_.offered()) offered = *g;
    }
  }
  if (phase == OnlinePhase::approach) shown_.follow(X_OW, offered ? &*offered : nullptr, now - shown_at_);
  shown_at_ = now;
  const std::scoped_lock lock(mutex_);
  if (phase == OnlinePhase::approach) ask_about_now(now);
  ++frame_;
  return view(now);
}

/// @pre both mutexes are held
OnlineView OnlinePlanner::Work::view(double now) const {
  OnlineView v;
  v.frame = frame_;
  v.time = now;
  v.phase = phase_;
  v.X_OH = shown_.X_OH();
  v.dofs = shown_.dofs();
  v.joints = shown_.joints();
  v.blocked = shown_.blocked();
  v.preshape = shown_.preshape();
  v.cone = cone_;
  v.rates = rates_;
  v.rates.postures_per_second = posture_rate_.per_second();
  v.rates.candidates_per_second = candidate_rate_.per_second();
  if (track_.newest()) {
    v.wrist = *track_.newest();
    v.solutions = solutions_.list(v.wrist.X_OH, now);
    if (const Grasp* g = solutions_.offered()) {
      v.offer = v.solutions.front();
      v.offer_X_OH = g->X_OH_pregrasp;
      v.offer_dofs = g->pregrasp_dofs;
    }
  }
  v.epsilon_now = epsilon_now();
  v.message = message();
  return v;
}

/// Of the grasp that is held; before that what closing would make at worst, as the hand trembles.
std::optional<double> OnlinePlanner::Work::epsilon_now() const {
  if (held_) return held_->form_closure ? held_->epsilon : -1.0;
  if (epsilons_now_.size() < tests_of_now) return std::nullopt;
  return *std::min_element(epsilons_now_.begin(), epsilons_now_.end());
}

std::string OnlinePlanner::Work::message() const {
  switch (phase_) {
    case OnlinePhase::waiting:
      return "Waiting for the first wrist pose.";
    case OnlinePhase::holding:
      return held_->form_closure ? "The grasp holds: form closure. Lift, or open the hand."
                                 : "The fingers are closed, but the grasp does not hold. Open the hand and "
                                   "try from another side.";
    case OnlinePhase::approach:
      break;
  }
  if (shown_.blocked()) return "The wrist is inside something: the hand stays where it is free. Draw back.";
  if (!solutions_.offered()) return "Searching ahead of the hand; no grasp in this direction yet.";
  if (epsilon_now().value_or(-1.0) > 0.0) return "Ready: closing the fingers now makes a stable grasp.";
  return "A grasp is offered: go on towards it, or choose another direction.";
}

}  // namespace eigengrasp
