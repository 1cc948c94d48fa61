// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/online/online_planner.hpp"
#include "online/approach_search.hpp"
#include "online/candidate_queue.hpp"
#include "online/rate_meter.hpp"
#include "online/shown_hand.hpp"
#include "online/solution_list.hpp"

namespace eigengrasp {

/// @throws Error where a target names a variable that there is not, or no finite value, or no confidence
void check_targets(const std::vector<VariableTarget>& targets, const HandModel& hand, int n_amplitudes);

/// The two stages of the online planner at work. The search has a thread, the tests have one or more; they
/// and the callers meet in what mutex_ guards, which none holds for longer than it takes to copy.
class OnlinePlanner::Work {
 public:
  Work(std::shared_ptr<const CollisionModel> model, const OnlineOptions& options);
  ~Work();

  WristTrack::Taken set_wrist(const WristSample& sample);
  void set_targets(std::vector<VariableTarget> targets);
  std::optional<Grasp> close();
  void open();
  void forget();
  OnlineView update();
  std::optional<Grasp> solution(std::uint64_t id) const;
  const Scene& scene() const { return model_->scene(); }
  const OnlineOptions& options() const { return options_; }

 private:
  /// What the search is to take up before its next step.
  struct Change {
    std::uint64_t wrist = 0;     ///< counts wrist poses
    std::uint64_t approach = 0;  ///< counts new approaches
    std::uint64_t targets = 0;   ///< counts lists of targets
  };
  /// A posture of the hand as it is shown, to be tested: what would "close" do now?
  struct NowRequest {
    Pose X_OH;
    VecX dofs;
  };

  void search();
  void take_up(const Change& change, Change& done, const Pose& X_OW,
               const std::vector<VariableTarget>& targets, ApproachSearch& search) const;
  void test();
  void keep(const Grasp& found);
  std::optional<Grasp> grasp_now(const Pose& X_OH, const std::vector<VecX>& postures) const;
  std::vector<VecX> postures_to_close(const VecX& shown) const;
  void ask_about_now(double now);
  OnlineView view(double now) const;
  std::optional<double> epsilon_now() const;
  std::string message() const;
  double seconds() const { return since_began_.seconds(); }

  std::shared_ptr<const CollisionModel> model_;
  OnlineOptions options_;
  GraspEnergy energy_;
  StopWatch since_began_;

  mutable std::mutex mutex_;
  std::condition_variable wake_search_;
  std::condition_variable wake_tests_;
  bool stop_ = false;
  OnlinePhase phase_ = OnlinePhase::waiting;
  WristTrack track_;
  std::vector<VariableTarget> targets_;
  Change change_;
  Pose X_OW_approach_ = Pose::Identity();  ///< where the present approach began
  double approach_began_ = 0.0;
  CandidateQueue queue_;
  SolutionList solutions_;
  std::optional<NowRequest> now_request_;
  std::deque<double> epsilons_now_;  ///< of the last few tests of the shown hand, which trembles
  double now_asked_ = -1.0;
  std::optional<Grasp> held_;
  OnlineRates rates_;
  RateMeter posture_rate_;
  RateMeter candidate_rate_;
  SearchCone cone_;
  std::uint64_t frame_ = 0;

  std::mutex shown_mutex_;  ///< of what follows; taken before mutex_ where both are
  ShownHand shown_;
  double shown_at_ = 0.0;

  std::vector<std::jthread> threads_;  ///< last: they use all of the above
};

}  // namespace eigengrasp
