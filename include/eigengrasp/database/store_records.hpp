// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/core/pose.hpp"
#include "eigengrasp/grasp/grasp.hpp"

namespace eigengrasp {

// What a grasp store holds. Plain data, SI. A name is 1 to 200 bytes of UTF-8 without control characters, and
// is what tells records of a kind apart.

/// An object. Its geometry is the file's coordinates times rescale, and times the scale of a work unit.
struct StoredModel {
  std::string name;
  std::string geometry_path;  ///< as the program that added it saw it; or library:NAME (jobs)
  std::string content_hash;   ///< of the geometry file's bytes (content_hash)
  std::vector<std::string> tags;
  double rescale = 1.0;  ///< file units to metres at scale 1, > 0
  double approximate_radius =
      0.0;                     ///< mean + 2 standard deviations of |surface - centre of mass|, scale 1 [m]
  std::string thumbnail_path;  ///< empty: none
  std::vector<double> scales = {0.75, 1.0, 1.25, 1.5};  ///< ascending, > 0; each is a scaled model

  bool operator==(const StoredModel&) const = default;
};

/// The name of a model at a scale: "psb_12" at 0.75 is psb_0.75_12, as in the Columbia Grasp Database; a name
/// that does not end in _NUMBER gets the scale at its end: glass_0.75.
std::string scaled_model_name(const std::string& model, double scale);

/// A hand. One of another friction is another hand, with a name of its own.
struct StoredHand {
  std::string name;
  std::vector<std::string> joints;  ///< movable ones, in the hand's order
  std::vector<std::string> dofs;    ///< in the order of Grasp::grasp_dofs
  std::vector<std::string> links;

  bool operator==(const StoredHand&) const = default;
};

/// Who makes grasps, such as a planner or a program.
struct GraspSource {
  std::string name;
  std::string description;

  bool operator==(const GraspSource&) const = default;
};

/// What a builder plans at a time.
struct UnitKey {
  std::string object;
  double scale = 1.0;
  std::string hand;

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 in what this makes for a pointer
  auto operator<=>(const UnitKey&) const = default;
};

enum class UnitState {
  waiting,  ///< for a worker
  claimed,  ///< by a worker, until its lease ends
  done,     ///< with its grasps
  failed,   ///< with a reason; stays so until it is reopened
};
const char* to_string(UnitState state);

struct StoredUnit {
  UnitKey key;
  UnitState state = UnitState::waiting;
  std::string reason;        ///< of a failure
  std::string worker;        ///< that holds or ended it
  double lease_until = 0.0;  ///< of a claim [s since 1970, UTC]; 0 otherwise
  double seconds = 0.0;      ///< that the work took

  bool operator==(const StoredUnit&) const = default;
};

/// A grasp and its source. The id is the store's own: it lasts as long as the store, and is not copied to
/// others.
struct StoredGrasp {
  std::int64_t id = 0;  ///< not looked at when a grasp is stored
  std::string source;
  Grasp grasp;
};

/// The outcome of a unit: done with grasps, or failed with a reason.
struct UnitResult {
  UnitKey key;
  UnitState state = UnitState::done;  ///< done or failed
  std::string reason;
  std::string worker;
  double seconds = 0.0;
  std::vector<StoredGrasp> grasps;  ///< best first; the order is kept
};

/// What describes an object's shape at scale 1, by a function (a name, such as "surface").
struct StoredDescriptor {
  std::string model;
  std::string function;
  std::string route;           ///< how it was made, such as "voxels"
  Vec3 center = Vec3::Zero();  ///< of the ball that was the unit ball, in the object's frame [m]
  double radius = 1.0;         ///< of that ball [m], > 0
  std::vector<double> invariants;

  bool operator==(const StoredDescriptor&) const = default;
};

/// How far another object is, by a distance function (a name, such as "zernike").
struct StoredNeighbor {
  std::string model;
  std::string neighbor;
  std::string distance_function;
  double distance = 0.0;

  bool operator==(const StoredNeighbor&) const = default;
};

/// The transform from one object's frame to another's, by a method (a name, such as "pca"). Scaling included.
struct StoredAlignment {
  std::string model;
  std::string target;
  std::string method;
  Eigen::Matrix4d X_target_model = Eigen::Matrix4d::Identity();  ///< translation in m

  bool operator==(const StoredAlignment&) const = default;
};

/// How much a store holds.
struct StoreCounts {
  std::int64_t models = 0, scaled_models = 0, hands = 0, sources = 0, grasps = 0, descriptors = 0,
               neighbors = 0, alignments = 0;
  std::int64_t waiting = 0, claimed = 0, done = 0, failed = 0;            ///< units
  std::vector<std::pair<std::string, std::int64_t>> grasps_by_hand = {};  ///< in the order of the hands

  bool operator==(const StoreCounts&) const = default;
};

}  // namespace eigengrasp
