// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "eigengrasp/grasp/collision_model.hpp"
#include "server/model_shelf.hpp"

namespace eigengrasp::server {

/// What a client plans in.
struct SceneRequest {
  std::string hand;
  std::string object;
  double scale = 1.0;
  bool table = false;
  std::optional<double> friction;
};

/// Scenes that were prepared, shared by all sessions; the last few are kept. From any thread.
class SceneCache {
 public:
  explicit SceneCache(const ModelShelf& shelf, std::shared_ptr<PreparationCache> files, int threads)
      : shelf_(shelf), files_(std::move(files)), threads_(threads) {}

  /// Cost: none, or up to some seconds where it has to be prepared; two that ask for the same at the same
  /// time wait for the same. @throws NotKnown, Error
  std::shared_ptr<const CollisionModel> get(const SceneRequest& request);

 private:
  using Model = std::shared_ptr<const CollisionModel>;
  struct Entry {
    std::string key;
    std::shared_future<Model> model;
  };
  static constexpr std::size_t kept = 6;

  Model prepare(const SceneRequest& request) const;

  const ModelShelf& shelf_;
  std::shared_ptr<PreparationCache> files_;
  int threads_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the last used first
};

/// Height of the table that stands right below an object [m].
double table_height(const ObjectModel& object);

}  // namespace eigengrasp::server
