// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/paper_scenes.hpp"

namespace eigengrasp {

PaperScenes::PaperScenes(const ModelSource& source, const std::vector<PaperHand>& hands,
                         const std::vector<PaperObject>& objects, const LogSink& log) {
  HandReadOptions options;
  options.log = log;
  for (const PaperHand hand : hands)
    hands_[hand] = std::make_shared<const HandModel>(load_paper_hand(source, hand, options));
  for (const PaperObject object : objects)
    objects_[object] = std::make_shared<const ObjectModel>(load_paper_object(source, object));
}

Scene PaperScenes::scene(PaperHand hand, PaperObject object, FrictionCase friction) const {
  Scene scene;
  scene.hand = hands_.at(hand);
  scene.object = objects_.at(object);
  scene.object_material.name = scene.object->material;
  if (friction == FrictionCase::one) set_friction(scene, 1.0);
  return scene;
}

}  // namespace eigengrasp
