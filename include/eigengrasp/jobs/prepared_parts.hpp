// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <memory>

#include "eigengrasp/database/store_records.hpp"
#include "eigengrasp/geometry/preparation_cache.hpp"
#include "eigengrasp/grasp/collision_model.hpp"

namespace eigengrasp {

/// A hand with what is made of its meshes. Immutable, shared by all threads and objects.
struct PreparedHand {
  std::shared_ptr<const HandModel> model;
  std::shared_ptr<const HandSurfaces> surfaces;
};
/// Cost: 0.3-4 s, 50 ms from the cache. @param cache of inner spheres and fields; may be null
PreparedHand prepare_hand(std::shared_ptr<const HandModel> hand, int threads, PreparationCache* cache);

/// What a store keeps of a hand.
StoredHand hand_record(const HandModel& hand);

/// What the geometry_path of an object of the library begins with; the object's name follows. Such a store is
/// good on every machine.
inline constexpr const char* kLibraryPath = "library:";

/// The file of an object's geometry on this machine. @throws Error where the library has no such object
std::filesystem::path geometry_file(const StoredModel& model);

/// An object of a store at scale 1, in metres. @throws Error where the geometry is missing, damaged, without
/// area, or another one than was added to the store
ObjectModel load_stored_object(const StoredModel& model);
/// The surface alone, which costs a third. @throws as load_stored_object
TriangleMesh load_stored_mesh(const StoredModel& model);

/// An object of a store, read and prepared once for all its scales and hands. For one thread.
class PreparedObject {
 public:
  /// Cost: 0.2-1 s, for the distance field. @throws as load_stored_object
  explicit PreparedObject(const StoredModel& model);

  /// The hand and the object at a scale. Cost: a hierarchy of the scaled mesh, the first time.
  /// @pre scale > 0
  std::unique_ptr<const CollisionModel> collision_model(const PreparedHand& hand, double scale);

 private:
  const std::shared_ptr<const ObjectModel>& at(double scale);

  std::shared_ptr<const ObjectModel> at_one_;
  DistanceField field_;
  std::map<double, std::shared_ptr<const ObjectModel>> scaled_;
};

}  // namespace eigengrasp
