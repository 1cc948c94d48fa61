// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>

#include "server/background.hpp"
#include "server/counter.hpp"
#include "server/model_shelf.hpp"
#include "server/plan_store.hpp"
#include "server/scene_cache.hpp"
#include "server/server_options.hpp"

namespace eigengrasp::server {

/// What all sessions share; outlives them.
struct Services {
  Services(const ServerOptions& o, std::shared_ptr<PreparationCache> files)
      : options(o), shelf(o.hand, o.object, o.limits), scenes(shelf, std::move(files), o.threads) {}

  wire::Limits wire_limits() const {
    return {options.limits.message_bytes, static_cast<std::int64_t>(options.limits.messages_per_second),
            options.limits.upload_bytes, options.limits.uploads};
  }

  ServerOptions options;
  ModelShelf shelf;
  SceneCache scenes;
  PlanStore plans;
  std::shared_ptr<Counter> running_plans = std::make_shared<Counter>();
  std::shared_ptr<Counter> online_sessions = std::make_shared<Counter>();
  Background background;
};

}  // namespace eigengrasp::server
