// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Plans a few grasps of a shipped object with a shipped hand and prints the quality of the best one.
// usage: best_grasp [HAND OBJECT]
#include <fmt/format.h>

#include <cstdio>
#include <eigengrasp/core/error.hpp>
#include <eigengrasp/model_io/hand_io.hpp>
#include <eigengrasp/model_io/object_io.hpp>
#include <eigengrasp/planning/grasp_planner.hpp>
#include <filesystem>
#include <memory>
#include <string>

namespace {

eigengrasp::Scene make_scene(const std::string& hand, const std::string& object) {
  const std::filesystem::path share = EIGENGRASP_SHARE;
  eigengrasp::Scene scene;
  scene.hand = std::make_shared<const eigengrasp::HandModel>(eigengrasp::load_hand(share / "hands" / hand));
  scene.object = std::make_shared<const eigengrasp::ObjectModel>(
      eigengrasp::load_object(share / "objects" / (object + ".obj")));
  return scene;
}

void print_best_grasp(const eigengrasp::Scene& scene) {
  eigengrasp::PlanOptions options;
  options.iterations = 20000;
  options.grasps = 10;
  options.seed = 7;
  const eigengrasp::PlanResult result = eigengrasp::plan_grasps(scene, options);
  if (result.status != eigengrasp::PlanStatus::found) {
    fmt::print("{}\n", result.explanation);
    return;
  }
  const eigengrasp::Grasp& best = result.grasps.front();
  fmt::print("{} on {}: epsilon {:.4f} with {} contacts\n", best.hand, best.object, best.epsilon,
             best.contacts.size());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    print_best_grasp(make_scene(argc > 2 ? argv[1] : "human", argc > 2 ? argv[2] : "glass"));
  } catch (const eigengrasp::Error& error) {
    fmt::print(stderr, "best_grasp: {}\n", error.what());
    return 2;
  }
  return 0;
}
