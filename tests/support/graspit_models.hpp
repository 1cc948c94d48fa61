// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "support/graspit_reference.hpp"

namespace eigengrasp::testing {

/// One line of the reference data, read.
struct ReferenceLine {
  std::string pair;  ///< hand/object
  Scene scene;
  Pose X_OH = Pose::Identity();
  nlohmann::json json;
};

inline VecX vector_of(const nlohmann::json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const VecX>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Calls visit for each line of a file of the reference data; lines of a pair of hand and object follow each
/// other. Hands and objects are loaded once.
inline void for_each_reference(const std::filesystem::path& file,
                               const std::function<void(const ReferenceLine&)>& visit) {
  std::map<std::string, std::shared_ptr<const HandModel>> hands;
  std::map<std::string, std::shared_ptr<const ObjectModel>> objects;
  std::ifstream in(file);
  for (std::string text; std::getline(in, text);) {
    ReferenceLine line;
    line.json = nlohmann::json::parse(text);
    const std::string hand = line.json["hand"];
    const std::string object = line.json["object"];
    line.pair = hand + "/" + object;
    if (!hands[hand]) hands[hand] = std::make_shared<const HandModel>(load_reference_hand(hand));
    if (!objects[object])
      objects[object] = std::make_shared<const ObjectModel>(
          load_graspit_body(graspit_models() / "objects" / (object + ".xml")));
    line.scene.hand = hands[hand];
    line.scene.object = objects[object];
    line.scene.object_material.name = objects[object]->material;
    const VecX pose = vector_of(line.json["hand_pose"]);
    line.X_OH =
        make_pose(Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]), 1e-3 * Vec3(pose.head<3>()));
    visit(line);
  }
}

/// The value below which the given share of the numbers lies.
inline double percentile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return 0.0;
  std::sort(numbers.begin(), numbers.end());
  const auto place = static_cast<std::size_t>(share * static_cast<double>(numbers.size() - 1) + 0.5);
  return numbers[place];
}

}  // namespace eigengrasp::testing
