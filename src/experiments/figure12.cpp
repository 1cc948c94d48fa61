// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/figure12.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "eigengrasp/core/core_watch.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/planning/pregrasp_rating.hpp"
#include "eigengrasp/transfer/grasp_transfer.hpp"
#include "experiments/figure12_progress.hpp"

namespace eigengrasp {

std::vector<std::string> Figure12Options::validate() const {
  std::vector<std::string> violations;
  if (hands.empty()) violations.emplace_back("hands is empty, expected at least one");
  if (neighbors < 1 || neighbors > 1000)
    violations.push_back(fmt::format("neighbors is {}, expected 1 to 1000", neighbors));
  if (candidates < 0)
    violations.push_back(fmt::format("candidates is {}, expected 0 (all) or more", candidates));
  if (every < 1) violations.push_back(fmt::format("every is {}, expected 1 or more", every));
  if (models < 0) violations.push_back(fmt::format("models is {}, expected 0 (all) or more", models));
  if (threads < 0 || threads > 4096)
    violations.push_back(fmt::format("threads is {}, expected 0 (all) to 4096", threads));
  return violations;
}

namespace {

constexpr std::array<NeighborDistance, 3> kDistances = {NeighborDistance::classes, NeighborDistance::zernike,
                                                        NeighborDistance::random};
constexpr std::size_t kPlanner = 3;

class Figure12Experiment {
 public:
  Figure12Experiment(GraspStore& store, const Figure12Options& options)
      : store_(store), options_(options), transfers_(store) {}

  Figure12 run();

 private:
  std::vector<const StoredModel*> pick_models();
  /// @param model of the store, whose place there goes into the seed, whichever models are picked
  Figure12Model run_model(const StoredModel& model) const;
  Figure12Run transfer(TransferTarget& target, const CollisionModel& collision, const PreparedHand& hand,
                       const NeighborQuery& query) const;
  Figure12Run planned(const StoredModel& model, const HandModel& hand) const;
  bool stopped() const { return options_.stop != nullptr && options_.stop->stop_requested(); }

  GraspStore& store_;
  const Figure12Options& options_;
  TransferStore transfers_;
  std::vector<PreparedHand> hands_;
  std::map<UnitKey, double> unit_seconds_;  ///< of units that have ended
  std::map<std::string, std::string> left_out_;
};

std::vector<const StoredModel*> Figure12Experiment::pick_models() {
  for (const StoredUnit& u : store_.units())
    if (u.state == UnitState::done || u.state == UnitState::failed) unit_seconds_[u.key] = u.seconds;
  std::vector<const StoredModel*> picked;
  const std::vector<StoredModel>& all = transfers_.models();
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(options_.every)) {
    if (options_.models > 0 && picked.size() == static_cast<std::size_t>(options_.models)) break;
    const bool ended = std::all_of(options_.hands.begin(), options_.hands.end(), [&](const auto& hand) {
      return unit_seconds_.contains({all[i].name, 1.0, hand->name});
    });
    if (!ended) {
      left_out_[all[i].name] = "its units at scale 1 have not ended";
    } else if (!transfers_.shapes().holds(all[i].name)) {
      left_out_[all[i].name] = "it has no descriptor";
    } else {
      picked.push_back(&all[i]);
    }
  }
  return picked;
}

Figure12Run Figure12Experiment::transfer(TransferTarget& target, const CollisionModel& collision,
                                         const PreparedHand& hand, const NeighborQuery& query) const {
  const CoreWatch watch;
  CandidateOptions options;
  options.neighbors = options_.neighbors;
  options.most = options_.candidates;
  const Candidates candidates =
      target.find_candidates(rank_neighbors(transfers_, query), {hand.model, hand.model}, options);
  PlanOptions plan;
  plan.search = SearchKind::transfer;
  plan.threads = 1;
  plan.grasps = kFigure12Ranks;
  plan.volumes = false;
  plan.amplitudes = std::min(2, hand.model->n_dof());
  plan.seed = options_.seed;
  plan.stop = options_.stop;
  const RatedPreGrasps rated = rate_pregrasps(collision, candidates.given, plan);
  Figure12Run run;
  for (const Grasp& g : rated.plan.grasps) run.epsilons.push_back(g.epsilon);
  run.distinct = rated.distinct;
  run.candidates = static_cast<int>(candidates.given.size());
  run.seconds = watch.seconds();
  return run;
}

/// What the store holds of the model itself.
Figure12Run Figure12Experiment::planned(const StoredModel& model, const HandModel& hand) const {
  Figure12Run run;
  for (const StoredGrasp& g : store_.grasps(model.name, hand.name))
    if (g.grasp.object_scale == 1.0 && g.grasp.form_closure) run.epsilons.push_back(g.grasp.epsilon);
  std::sort(run.epsilons.rbegin(), run.epsilons.rend());
  run.distinct = static_cast<int>(run.epsilons.size());
  run.epsilons.resize(std::min<std::size_t>(run.epsilons.size(), kFigure12Ranks));
  run.seconds = unit_seconds_.at({model.name, 1.0, hand.name});
  return run;
}

Figure12Model Figure12Experiment::run_model(const StoredModel& model) const {
  Figure12Model result;
  result.name = model.name;
  const CoreWatch watch;
  Scene scene;
  scene.object = std::make_shared<const ObjectModel>(load_stored_object(model));
  scene.object_material.name = scene.object->material;
  TransferTarget target(transfers_, *scene.object);
  result.prepare_seconds = watch.seconds();
  CollisionModel::Options options;
  options.threads = 1;
  options.fast = false;
  NeighborQuery query;
  query.values = transfers_.shapes().values(model.name);
  query.tags = model.tags;
  query.seed = options_.seed * 1000003 + static_cast<std::uint64_t>(&model - transfers_.models().data());
  query.without = {model.name};
  for (const PreparedHand& hand : hands_) {
    scene.hand = hand.model;
    const CollisionModel collision(scene, options, {hand.surfaces, {}});
    std::array<Figure12Run, 4>& runs = result.runs.emplace_back();
    for (std::size_t m = 0; m < kDistances.size(); ++m) {
      query.distance = kDistances[m] == NeighborDistance::classes && model.tags.empty()
                           ? NeighborDistance::random
                           : kDistances[m];
      runs[m] = transfer(target, collision, hand, query);
    }
    runs[kPlanner] = planned(model, *hand.model);
  }
  return result;
}

Figure12 Figure12Experiment::run() {
  const StopWatch whole;
  const std::vector<const StoredModel*> models = pick_models();
  if (models.empty())
    fail(
        "{}: none of its objects has ended at scale 1 with all of the hands and has a descriptor; "
        "'eigengrasp db "
        "build' and 'eigengrasp db describe' make both",
        store_.place());
  for (const auto& hand : options_.hands)
    hands_.push_back({hand, std::make_shared<const HandSurfaces>(*hand, 0.0, options_.threads)});
  Figure12Progress progress(options_);
  std::vector<std::optional<Figure12Model>> done(models.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < models.size(); ++i) {
    done[i] = progress.find(models[i]->name);
    if (!done[i]) missing.push_back(i);
  }
  std::mutex mutex;
  std::size_t n_done = models.size() - missing.size();
  parallel_for(missing.size(), options_.threads, [&](std::size_t k, int) {
    if (stopped()) return;
    const std::size_t i = missing[k];
    try {
      Figure12Model model = run_model(*models[i]);
      if (stopped()) return;
      const std::scoped_lock lock(mutex);
      progress.add(model);
      done[i] = std::move(model);
    } catch (const Error& e) {
      const std::scoped_lock lock(mutex);
      left_out_[models[i]->name] = e.what();
    }
    const std::scoped_lock lock(mutex);
    ++n_done;
    if (options_.progress)
      options_.progress(static_cast<double>(n_done) / static_cast<double>(models.size()), models[i]->name);
  });
  std::vector<Figure12Model> all;
  for (std::optional<Figure12Model>& model : done)
    if (model) all.push_back(std::move(*model));
  std::vector<std::string> names;
  for (const auto& hand : options_.hands) names.push_back(hand->name);
  Figure12 result = summarise_figure12(all, names);
  result.left_out = std::move(left_out_);
  result.resumed = static_cast<int>(models.size() - missing.size());
  result.neighbors = options_.neighbors;
  result.candidates = options_.candidates;
  result.seed = options_.seed;
  result.stopped_early = stopped();
  result.wall_seconds = whole.seconds();
  return result;
}

void add_to_mean(const Figure12Run& run, double share, Figure12Curve& curve) {
  for (std::size_t n = 0; n < run.epsilons.size(); ++n) curve.epsilon[n] += share * run.epsilons[n];
  curve.distinct += share * run.distinct;
  curve.candidates += share * run.candidates;
  curve.seconds += share * run.seconds;
  if (run.epsilons.empty()) ++curve.without;
}

}  // namespace

Figure12 summarise_figure12(const std::vector<Figure12Model>& models, const std::vector<std::string>& hands) {
  Figure12 result;
  result.hands = hands;
  result.models = static_cast<int>(models.size());
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(models.size(), 1));
  Figure12Curve empty;
  empty.epsilon.assign(kFigure12Ranks, 0.0);
  for (std::size_t h = 0; h < hands.size(); ++h) {
    std::array<Figure12Curve, 4>& curves = result.curves.emplace_back();
    curves.fill(empty);
    for (const Figure12Model& model : models)
      for (std::size_t m = 0; m < curves.size(); ++m) add_to_mean(model.runs[h][m], share, curves[m]);
  }
  for (const Figure12Model& model : models) result.prepare_seconds += share * model.prepare_seconds;
  return result;
}

Figure12 run_figure12(GraspStore& store, const Figure12Options& options) {
  if (const auto violations = options.validate(); !violations.empty()) throw Error(violations.front());
  return Figure12Experiment(store, options).run();
}

}  // namespace eigengrasp
