// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/transfer/neighbor_ranking.hpp"

#include <algorithm>
#include <set>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/random.hpp"

namespace eigengrasp {

namespace {

constexpr std::pair<NeighborDistance, const char*> kDistanceNames[] = {{NeighborDistance::zernike, "zernike"},
                                                                       {NeighborDistance::views, "views"},
                                                                       {NeighborDistance::classes, "class"},
                                                                       {NeighborDistance::random, "random"}};

}  // namespace

const char* to_string(NeighborDistance distance) {
  for (const auto& [value, name] : kDistanceNames)
    if (value == distance) return name;
  return "";
}

NeighborDistance parse_neighbor_distance(const std::string& name) {
  for (const auto& [value, known] : kDistanceNames)
    if (name == known) return value;
  fail("the distance is '{}', expected zernike, views, class or random", name);
}

TransferStore::TransferStore(GraspStore& store) : store_(store), models_(store.models()), shapes_(store) {
  if (models_.empty())
    fail(
        "{}: holds no objects; 'eigengrasp db add-objects' adds them, and 'eigengrasp db build' plans grasps",
        store.place());
  for (std::size_t i = 0; i < models_.size(); ++i) places_.emplace(models_[i].name, i);
}

const StoredViews& TransferStore::views() const {
  std::call_once(views_read_, [this] { views_.emplace(store_); });
  return *views_;
}

const StoredModel* TransferStore::find(const std::string& name) const {
  const auto place = places_.find(name);
  return place == places_.end() ? nullptr : &models_[place->second];
}

namespace {

std::vector<RankedNeighbor> by_descriptor(const TransferStore& store, const NeighborQuery& query) {
  if (store.shapes().size() == 0)
    fail("{}: holds no shape descriptors; 'eigengrasp db describe' computes them", store.store().place());
  std::vector<RankedNeighbor> ranked;
  for (const auto& [name, distance] :
       store.shapes().find_nearest(query.values, store.shapes().size(), query.without))
    ranked.push_back({store.find(name), distance});
  return ranked;
}

std::vector<RankedNeighbor> by_views(const TransferStore& store, const NeighborQuery& query) {
  if (store.views().empty())
    fail("{}: holds no descriptors of views; 'eigengrasp db describe' computes them", store.store().place());
  std::vector<RankedNeighbor> ranked;
  for (const auto& [name, distance] : store.views().rank(query.values, query.without))
    ranked.push_back({store.find(name), distance});
  return ranked;
}

std::size_t common_tags(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::size_t n = 0;
  while (n < std::min(a.size(), b.size()) && a[n] == b[n]) ++n;
  return n;
}

/// In an order that the seed tells.
std::vector<RankedNeighbor> shuffled(const TransferStore& store, const NeighborQuery& query) {
  const std::set<std::string> without(query.without.begin(), query.without.end());
  std::vector<std::pair<std::uint64_t, RankedNeighbor>> keyed;
  for (std::size_t i = 0; i < store.models().size(); ++i)
    if (!without.contains(store.models()[i].name))
      keyed.emplace_back(RandomStream({query.seed, i})(), RankedNeighbor{&store.models()[i], 0.0});
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<RankedNeighbor> ranked;
  for (const auto& [key, neighbor] : keyed) ranked.push_back(neighbor);
  return ranked;
}

std::vector<RankedNeighbor> by_class(const TransferStore& store, const NeighborQuery& query) {
  if (query.tags.empty())
    fail(
        "the object has no class; name its tags, outermost first, or choose another distance than class "
        "(zernike, random)");
  std::vector<RankedNeighbor> ranked = shuffled(store, query);
  for (RankedNeighbor& n : ranked)
    n.distance = static_cast<double>(query.tags.size() - common_tags(query.tags, n.model->tags));
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const RankedNeighbor& a, const RankedNeighbor& b) { return a.distance < b.distance; });
  return ranked;
}

}  // namespace

std::vector<RankedNeighbor> rank_neighbors(const TransferStore& store, const NeighborQuery& query) {
  switch (query.distance) {
    case NeighborDistance::zernike:
      return by_descriptor(store, query);
    case NeighborDistance::views:
      return by_views(store, query);
    case NeighborDistance::classes:
      return by_class(store, query);
    case NeighborDistance::random:
      break;
  }
  return shuffled(store, query);
}

}  // namespace eigengrasp
