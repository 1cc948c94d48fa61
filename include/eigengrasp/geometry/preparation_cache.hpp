// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "eigengrasp/core/log.hpp"
#include "eigengrasp/geometry/distance_field.hpp"
#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/geometry/sphere_cover.hpp"

namespace eigengrasp {

struct PreparationCacheOptions {
  std::filesystem::path folder;                        ///< made where it is missing; empty: nothing on disk
  std::uintmax_t max_bytes = std::uintmax_t{2} << 30;  ///< of the folder; the files unused longest go first
  LogSink log = {};                                    ///< hears once that the folder cannot be written to
};

/// Keeps what is made of meshes: distance fields and inner spheres. On disk, one file each, found by a hash
/// of the mesh and the options; and in memory, distance fields that are still in use. What it returns is
/// bit-identical to what is made anew. Files that are damaged, foreign or of another version are as if they
/// were not there; a folder that cannot be written to costs only time. Any number of threads and processes.
class PreparationCache {
 public:
  explicit PreparationCache(PreparationCacheOptions options);

  /// The field of an object: made of its mesh before it was rescaled and scaled as the object is, so that all
  /// scales of an object share one. Cost: some ms where it is on disk.
  DistanceField object_field(const ObjectModel& object, const DistanceFieldOptions& options);
  /// The field of any mesh. @param mesh that the hierarchy was made of
  DistanceField field(const TriangleMesh& mesh, const MeshBvh& bvh, const DistanceFieldOptions& options);
  /// As cover_with_inner_spheres.
  std::vector<Sphere> inner_spheres(const TriangleMesh& mesh, const MeshBvh& bvh, double tolerance);
  /// These spheres as they are after grow_to_hold.
  std::vector<Sphere> holding_spheres(const TriangleMesh& mesh, const MeshBvh& bvh, double tolerance);

 private:
  DistanceField field_of(const std::string& content_key, const MeshBvh& bvh,
                         const DistanceFieldOptions& options);
  std::vector<Sphere> spheres_of(const std::string& key, const std::function<std::vector<Sphere>()>& make);
  std::filesystem::path file_of(const std::string& key) const;
  std::optional<std::string> read(const std::string& key) const;
  void write(const std::string& key, const std::string& payload);
  void remove_oldest() const;

  PreparationCacheOptions options_;
  std::mutex mutex_;
  std::unordered_map<std::string, std::weak_ptr<const DistanceField::Grids>> in_use_;
  bool told_ = false;
};

/// The user's cache folder: $EIGENGRASP_CACHE, else eigengrasp in $XDG_CACHE_HOME, else ~/.cache/eigengrasp.
/// Empty where EIGENGRASP_CACHE is "off", or where there is no home.
std::filesystem::path user_cache_folder();

/// The object's field at its scale, from the cache where there is one.
DistanceField make_object_field(const ObjectModel& object, const DistanceFieldOptions& options,
                                PreparationCache* cache = nullptr);

}  // namespace eigengrasp
