// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/transfer/grasp_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "transfer/transfer_summary.hpp"

namespace eigengrasp {

std::vector<std::string> TransferOptions::validate(const HandModel& hand) const {
  std::vector<std::string> violations = plan.validate(hand);
  if (candidates.neighbors < 1 || candidates.neighbors > 1000)
    violations.push_back(fmt::format("neighbors is {}, expected 1 to 1000", candidates.neighbors));
  if (candidates.most < 0)
    violations.push_back(fmt::format("candidates is {}, expected 0 (all) or more", candidates.most));
  if (!(min_epsilon >= 0.0) || !(min_epsilon <= 1.0))
    violations.push_back(fmt::format("min epsilon is {}, expected 0 to 1", min_epsilon));
  if (!candidates.alignment.empty() && candidates.alignment != kPcaAlignment &&
      candidates.alignment != kIcpAlignment)
    violations.push_back(fmt::format("the alignment is '{}', expected {} or {}", candidates.alignment,
                                     kPcaAlignment, kIcpAlignment));
  return violations;
}

namespace {

void require_known_hand(GraspStore& store, const HandModel& hand) {
  std::string names;
  for (const StoredHand& known : store.hands()) {
    if (known.name == hand.name && known != hand_record(hand))
      fail(
          "{}: its hand '{}' has other joints or links than the given one; name the hand that it was built "
          "with",
          store.place(), hand.name);
    if (known.name == hand.name) return;
    names += (names.empty() ? "" : ", ") + known.name;
  }
  if (names.empty()) fail("{}: holds no grasps; 'eigengrasp db build' plans them", store.place());
  fail("{}: holds no grasps with the hand '{}'; it has those with {}", store.place(), hand.name, names);
}

/// With what was left open.
TransferOptions completed(TransferOptions options, const ObjectModel& object, const TransferStore& store) {
  if (!options.distance)
    options.distance =
        object.seen && !store.views().empty() ? NeighborDistance::views : NeighborDistance::zernike;
  if (options.candidates.alignment.empty())
    options.candidates.alignment = object.seen ? kIcpAlignment : kPcaAlignment;
  return options;
}

class Transfer {
 public:
  Transfer(const Scene& scene, const TransferStore& store, const TransferOptions& options)
      : scene_(scene),
        store_(store),
        options_(completed(options, *scene.object, store)),
        hands_{options.from_hand, scene.hand} {
    if (!hands_.from) hands_.from = scene.hand;
  }

  TransferResult run();

 private:
  void find_candidates();
  const TriangleMesh& part_seen() const;
  NeighborQuery query() const;
  std::unique_ptr<const CollisionModel> prepare(int threads) const;

  const Scene& scene_;
  const TransferStore& store_;
  TransferOptions options_;
  HandPair hands_;
  Candidates candidates_;
};

const TriangleMesh& Transfer::part_seen() const {
  if (!scene_.object->seen)
    fail("{}: is no scan of one side, so that it cannot be looked up among views; take another distance",
         scene_.object->name);
  return *scene_.object->seen;
}

NeighborQuery Transfer::query() const {
  NeighborQuery query;
  query.distance = *options_.distance;
  query.tags = options_.tags;
  query.seed = options_.plan.seed;
  query.without = options_.without;
  if (query.distance == NeighborDistance::zernike && store_.shapes().size() > 0)
    query.values = describe_object(scene_.object->mesh).values;
  if (query.distance == NeighborDistance::views) query.values = describe_object(part_seen()).values;
  return query;
}

void Transfer::find_candidates() {
  TransferTarget target(store_, *scene_.object);
  candidates_ = target.find_candidates(rank_neighbors(store_, query()), hands_, options_.candidates);
}

/// For exact queries alone: fields and spheres would take longer than they save.
std::unique_ptr<const CollisionModel> Transfer::prepare(int threads) const {
  CollisionModel::Options options;
  options.threads = threads;
  options.fast = false;
  return std::make_unique<const CollisionModel>(scene_, options);
}

/// The scene is prepared while the neighbours are looked for.
TransferResult Transfer::run() {
  const StopWatch whole;
  TransferResult result;
  std::unique_ptr<const CollisionModel> model;
  const int all = options_.plan.threads > 0 ? options_.plan.threads : hardware_threads();
  parallel_for(2, all, [&](std::size_t part, int) {
    StopWatch watch;
    if (part == 0) {
      model = prepare(std::max(1, all - 1));
      result.timings.prepare = watch.lap();
    } else {
      find_candidates();
      result.timings.neighbors = watch.lap();
    }
  });
  StopWatch watch;
  PlanOptions plan = options_.plan;
  plan.search = SearchKind::transfer;
  RatedPreGrasps rated = rate_pregrasps(*model, candidates_.given, plan, options_.min_epsilon);
  result.timings.rate = watch.lap();
  result.distinct = rated.distinct;
  result.neighbors = std::move(candidates_.neighbors);
  result.form_closed.assign(result.neighbors.size(), 0);
  for (std::size_t i = 0; i < rated.outcomes.size(); ++i)
    if (rated.outcomes[i] == GivenOutcome::form_closed) ++result.form_closed[candidates_.origins[i].neighbor];
  for (const std::size_t i : rated.origins) result.origins.push_back(candidates_.origins[i]);
  result.plan = std::move(rated.plan);
  for (Grasp& g : result.plan.grasps) g.provenance.planner = transfer_planner_name(options_);
  result.timings.total = whole.seconds();
  result.plan.timings.prepare = result.timings.prepare;
  result.plan.timings.search = result.timings.neighbors;
  result.plan.timings.total = result.timings.total;
  explain_transfer(*scene_.object, options_, result);
  return result;
}

}  // namespace

TransferResult transfer_grasps(const Scene& scene, const TransferStore& store,
                               const TransferOptions& options) {
  if (const auto violations = options.validate(*scene.hand); !violations.empty())
    throw Error(violations.front());
  require_known_hand(store.store(), options.from_hand ? *options.from_hand : *scene.hand);
  return Transfer(scene, store, options).run();
}

}  // namespace eigengrasp
