// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <string>

#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "support/test_data.hpp"

namespace eigengrasp::testing {

/// A hand of data/hands with an object of data/objects, made `scale` times larger.
inline Scene shipped_scene(const std::string& hand, const std::string& object, double scale = 1.0) {
  Scene scene;
  scene.hand = std::make_shared<const HandModel>(load_hand(source_path("data/hands") / hand / "hand.yaml"));
  const ObjectModel model = load_object(source_path("data/objects") / (object + ".obj"));
  scene.object = std::make_shared<const ObjectModel>(scale == 1.0 ? model : rescaled(model, scale));
  return scene;
}

}  // namespace eigengrasp::testing
