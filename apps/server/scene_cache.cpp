// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/scene_cache.hpp"

#include <algorithm>

namespace eigengrasp::server {

namespace {

std::string key_of(const SceneRequest& r) {
  return fmt::format("{}\n{}\n{}\n{}\n{}", r.hand, r.object, r.scale, r.table, r.friction.value_or(-1.0));
}

}  // namespace

double table_height(const ObjectModel& object) {
  return bounding_box(object.mesh).min.z();
}

std::shared_ptr<const CollisionModel> SceneCache::get(const SceneRequest& request) {
  const std::string key = key_of(request);
  std::promise<Model> promise;
  std::shared_future<Model> model;
  bool mine = false;
  {
    const std::lock_guard lock(mutex_);
    auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
    if (found == entries_.end()) {
      mine = true;
      entries_.push_front({key, promise.get_future().share()});
      if (entries_.size() > kept) entries_.pop_back();
    } else {
      entries_.splice(entries_.begin(), entries_, found);
    }
    model = entries_.front().model;
  }
  if (!mine) return model.get();
  try {
    promise.set_value(prepare(request));
  } catch (...) {
    promise.set_exception(std::current_exception());
    const std::lock_guard lock(mutex_);
    entries_.remove_if([&](const Entry& e) { return e.key == key; });
  }
  return model.get();
}

SceneCache::Model SceneCache::prepare(const SceneRequest& request) const {
  Scene scene;
  scene.hand = shelf_.hand(request.hand);
  scene.object = shelf_.object(request.object);
  if (request.scale != 1.0)
    scene.object = std::make_shared<ObjectModel>(rescaled(*scene.object, request.scale));
  scene.object_material.name = scene.object->material;
  if (request.table) scene.obstacles.push_back(make_table(table_height(*scene.object)));
  if (request.friction) set_friction(scene, *request.friction);
  CollisionModel::Options options;
  options.threads = threads_;
  options.cache = files_;
  return std::make_shared<const CollisionModel>(std::move(scene), options);
}

}  // namespace eigengrasp::server
