// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/geometry/preparation_cache.hpp"
#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/quality/wrench_space.hpp"

namespace eigengrasp {

/// What the search minimises.
enum class EnergyKind {
  contact,  ///< eqs. (6), (7): distance and alignment of the virtual contacts
  wrench,   ///< eq. (8): epsilon of the wrench space of the virtual contacts, each scaled by 1 - delta
};

/// How the search spends its budget of states.
enum class SearchKind {
  paper,   ///< section III-A as it stands: one chain of annealing, the best distinct states are closed at the
           ///< end
  staged,  ///< many short chains side by side; what they find is closed while the search goes on (as in
           ///< section IV-D), and pre-grasps that close are preferred
  tempering,  ///< as staged, but the chains of a stage do not cool: they stand on a ladder of temperatures
              ///< and trade them (parallel tempering)
  enhanced,  ///< section V-B: a parent looks for pre-grasps, each is refined towards form closure by a child,
             ///< and the parent keeps away from there; until as many grasps as wanted are found
  transfer,  ///< section VI: none; pre-grasps of like objects are fitted, see rate_pregrasps
};

struct PlanProgress {
  std::int64_t iterations = 0;        ///< done so far, all chains together
  std::int64_t iterations_total = 0;  ///< 0 where only a time limit was given
  double seconds = 0.0;
  double best_energy = 0.0;
};

/// The best state of the search at one iteration (Fig. 2 of the paper).
struct SearchMilestone {
  std::int64_t iteration = 0;
  double energy = 0.0;
  Pose X_OH = Pose::Identity();
  VecX dofs;
};

struct PlanOptions {
  std::int64_t iterations =
      70000;                ///< states drawn and evaluated, all chains together; 0: until the time limit
  double time_limit = 0.0;  ///< [s]; 0: none. With a time limit the result depends on the machine's speed
  int grasps = 20;          ///< pre-grasps that are kept, closed and rated; enhanced: form-closed grasps
  std::uint64_t seed = 1;
  int threads = 0;     ///< 0: all. Does not change the result
  int chains = 32;     ///< of all but the paper's search, side by side; rounded up to whole sixteens
  int amplitudes = 2;  ///< eigengrasps that are searched; hand.n_dof(): all degrees of freedom
  EnergyKind energy = EnergyKind::contact;
  SearchKind search = SearchKind::staged;
  /// Tells of every state whether it is legal, also of those whose energy is too high to be taken anyway.
  /// Changes nothing but StateCounts, and costs time.
  bool judge_all = false;
  double alpha =
      0.050;  ///< length [m] that weighs as much as a contact normal that is 90 degrees off, eq. (6)
  WrenchNorm norm = WrenchNorm::l1;
  ConeModel cone = ConeModel::edges;
  int cone_edges = 8;
  double epsilon_min = 1e-6;  ///< form closure: epsilon at least this
  double torque_scale = 0.0;  ///< [m]; 0: the object's max_radius
  bool volumes = true;  ///< of the wrench spaces of the grasps that are kept, 2-15 ms each; false: they are 0
  std::shared_ptr<PreparationCache> cache = {};  ///< keeps what is made of meshes; none: all is made anew
  const StopFlag* stop = nullptr;  ///< asked every few milliseconds; what was found until then is returned
  std::function<void(const PlanProgress&)> progress =
      {};  ///< called from one thread, some times a second; may be empty
  /// Hears at once of states that are better than all that it heard of before; `iteration` counts those of
  /// all chains. Called from any thread of the search, one call at a time; may be empty.
  std::function<void(const SearchMilestone&)> milestone = {};

  /// All violations as sentences: name, value, bound. Empty: the options are sound.
  std::vector<std::string> validate(const HandModel& hand) const;
};

/// What became of the states that the search drew. Without PlanOptions::judge_all, states whose energy is too
/// high to be taken are only asked whether the hand hits itself, and count as legal where it does not.
struct StateCounts {
  std::int64_t evaluated = 0;
  std::int64_t legal = 0;
  std::int64_t hit_object = 0;
  std::int64_t hit_itself = 0;
  std::int64_t hit_obstacle = 0;

  StateCounts& operator+=(const StateCounts& other) {
    evaluated += other.evaluated;
    legal += other.legal;
    hit_object += other.hit_object;
    hit_itself += other.hit_itself;
    hit_obstacle += other.hit_obstacle;
    return *this;
  }
};

/// What became of the pre-grasps that were closed and kept; of the enhanced search: of all that children had.
struct CandidateCounts {
  int tested = 0;
  int form_closed = 0;
  int not_closed = 0;  ///< touched the object, but epsilon below epsilon_min
  int no_contact = 0;
  int penetrating = 0;  ///< refused by the exact check of the closed hand
};

struct PlanTimings {
  double prepare = 0.0;  ///< [s] distance field, hand proxies
  double search = 0.0;   ///< the whole search, with what it closes on the way
  double close = 0.0;    ///< exact legality, closing, contacts, epsilon and exact check: after the paper's
                         ///< search, on the way of the staged one
  double total = 0.0;
  double anneal = 0.0;  ///< of the search: drawing and evaluating states
  double volume = 0.0;  ///< of the wrench spaces of the grasps that are kept
};

enum class PlanStatus {
  found,          ///< at least one form-closed grasp
  none_closed,    ///< pre-grasps were found, none closed to form closure
  nothing_legal,  ///< no legal state near the object was found
};

struct PlanResult {
  PlanStatus status = PlanStatus::nothing_legal;
  bool stopped_early = false;  ///< by the stop flag, or by the time limit before the iterations were done
  std::vector<Grasp> grasps;   ///< form-closed ones first, by falling epsilon; then the rest by rising energy
                               ///< (none from the enhanced search)
  StateCounts states;
  CandidateCounts candidates;
  int closed_on_the_way = 0;  ///< pre-grasps in all; the staged search closes more than it keeps
  PlanTimings timings;
  std::vector<SearchMilestone> milestones;  ///< of the chain that found the best state
  std::string explanation;                  ///< one sentence: what was found, or why nothing was, with counts
};

/// Plans form-closure grasps of the scene's object: searches eigengrasp space and wrist pose for pre-grasps
/// (sections II, III of the paper), closes the fingers (section III-D), finds the contacts and rates them.
/// The result depends on the scene and the options alone, never on the number of threads (but for a time
/// limit).
/// @throws Error with the sentences of validate() where the options are not sound.
PlanResult plan_grasps(const Scene& scene, const PlanOptions& options);
/// The same for a scene that was prepared before; timings.prepare is then what is left to prepare.
/// @pre the model was prepared with Options::fast
PlanResult plan_grasps(const CollisionModel& model, const PlanOptions& options);

}  // namespace eigengrasp
