// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/jobs/stored_shapes.hpp"
#include "eigengrasp/jobs/stored_views.hpp"

namespace eigengrasp {

/// Which objects of a store count as like the object to be grasped (section VI-B of the paper).
enum class NeighborDistance {
  zernike,  ///< the least distance of the descriptors
  views,    ///< the least distance of a view's descriptor from those of the views that are stored
  classes,  ///< the longest common part of the tags, which name a class, outermost first; else arbitrary
  random,   ///< arbitrary: the paper's unordered neighbours
};

/// "zernike", "views", "class", "random".
const char* to_string(NeighborDistance distance);
/// @throws Error for another name, listing these
NeighborDistance parse_neighbor_distance(const std::string& name);

/// What a transfer needs of a store's objects, read once. The store's calls may come from several threads.
class TransferStore {
 public:
  /// Cost: 30 ms for 2,000 objects. @throws Error where the store holds no objects, or is damaged
  explicit TransferStore(GraspStore& store);

  GraspStore& store() const { return store_; }
  const std::vector<StoredModel>& models() const { return models_; }
  /// Null where there is no such object.
  const StoredModel* find(const std::string& name) const;
  const StoredShapes& shapes() const { return shapes_; }
  /// Read when they are first asked for. @throws as StoredViews
  const StoredViews& views() const;

 private:
  GraspStore& store_;
  std::vector<StoredModel> models_;
  std::map<std::string, std::size_t> places_;
  StoredShapes shapes_;
  mutable std::once_flag views_read_;
  mutable std::optional<StoredViews> views_;
};

struct NeighborQuery {
  NeighborDistance distance = NeighborDistance::zernike;
  std::vector<float> values;         ///< of the object's descriptor, or of its view's; of zernike and views
  std::vector<std::string> tags;     ///< of the object; of classes alone
  std::uint64_t seed = 1;            ///< of what is arbitrary
  std::vector<std::string> without;  ///< objects that are left out
};

struct RankedNeighbor {
  const StoredModel* model = nullptr;  ///< in the TransferStore
  double distance =
      0.0;  ///< zernike, views: of the descriptors; classes: tags that are not common; random: 0
};

/// All objects of the store but for those left out, the most like one first. By zernike and views only those
/// that are described. Cost: below 1 ms for 2,000 objects.
/// @throws Error where nothing is described (zernike, views), or tags are missing (classes)
std::vector<RankedNeighbor> rank_neighbors(const TransferStore& store, const NeighborQuery& query);

}  // namespace eigengrasp
