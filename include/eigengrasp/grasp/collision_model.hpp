// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <vector>

#include "eigengrasp/geometry/ball_cover.hpp"
#include "eigengrasp/geometry/distance_field.hpp"
#include "eigengrasp/geometry/preparation_cache.hpp"
#include "eigengrasp/geometry/sphere_cover.hpp"
#include "eigengrasp/grasp/scene.hpp"

namespace eigengrasp {

struct HandProximity;

/// Whether a state may be, and if not, why. Joint limits are kept by clamping and are never a reason.
enum class Legality { legal, hits_object, hits_itself, hits_obstacle };

/// A sentence's middle: "collides with the object", ...
const char* describe(Legality legality);

/// Surfaces of a hand's links prepared for collision queries. Immutable, shared. One entry a link, empty for
/// links without mesh.
struct HandSurfaces {
  struct LinkSurface {
    MeshBvh bvh;
    std::vector<Sphere> inner_spheres;  ///< in the link frame, ordered by group
    std::vector<SphereGroup> groups;    ///< of the inner spheres
    BallCover cover;                    ///< these grown until they hold the whole mesh
    Sphere bound;                       ///< of the whole mesh
    DistanceField field;                ///< in the link frame, near the link
    bool empty() const { return bvh.empty(); }
  };
  std::vector<LinkSurface> links;

  HandSurfaces() = default;
  /// Cost: 0.3-4 s, some ms from the cache. @param cover_tolerance of the inner spheres [m]
  HandSurfaces(const HandModel& hand, double cover_tolerance, int threads, PreparationCache* cache = nullptr);
};

/// What the hand can hit: the object, obstacles, itself. Immutable, shared by all threads. All link poses are
/// X_OL (n_links).
class CollisionModel {
 public:
  struct Options {
    double cover_tolerance = 0.0010;  ///< [m] deepest intrusion that no inner sphere notices
    /// [m] Spheres that intrude less are let pass; negative: those that come nearer are refused, which makes
    /// up for part of the cover's tolerance and the field's error.
    double refuse_depth = -0.0004;
    bool fast = true;  ///< prepare distance fields and spheres; else only exact queries work
    int threads = 0;
    std::shared_ptr<PreparationCache> cache = {};  ///< of fields and spheres; none: all is made anew
  };

  /// What many scenes have in common: the hand's surfaces, made with the cover_tolerance of the options, and
  /// the object's field.
  struct Prepared {
    std::shared_ptr<const HandSurfaces> hand;
    DistanceField object;
  };

  CollisionModel(Scene scene, const Options& options);
  /// Of parts that were made before. Cost: nearly none without obstacles.
  CollisionModel(Scene scene, const Options& options, Prepared prepared);

  const Scene& scene() const { return scene_; }
  const HandSurfaces& surfaces() const { return *surfaces_; }
  const DistanceField& object_field() const { return object_field_; }
  /// Of an obstacle of the scene, in its frame B.
  const DistanceField& obstacle_field(std::size_t obstacle) const { return obstacle_fields_[obstacle]; }
  const Options& options() const { return options_; }

  /// Inner spheres against distance fields and each other. Refuses what comes nearer than -refuse_depth to a
  /// sphere, and calls legal what intrudes by less than about 1 mm; what is reported is checked exactly.
  /// Cost: 10-100 us; StateEvaluator does many states at once for a hundredth.
  /// @pre options.fast
  Legality check_fast(const std::vector<Pose>& X_OL) const;

  /// Surfaces of the meshes against each other, and containment. Cost: 50-300 us.
  Legality check_exact(const std::vector<Pose>& X_OL) const;

  /// Links whose surface crosses the object's or lies inside it count; a link wholly inside the object is
  /// told apart here.
  struct ObjectOverlap {
    bool crosses = false;
    bool contained = false;
  };
  ObjectOverlap overlap_with_object(int link, const Pose& X_OL) const;

  /// Deepest point [m] of the hand inside the object, an obstacle or another link of the hand, or of those
  /// inside it, over the mesh vertices and surface samples at 1.5 mm; 0 where nothing crosses. Cost: 0.1-50
  /// ms, 0.02 ms where it is known of all surfaces that they are apart.
  /// @param known of this pose: the same result without looking for crossings there
  double deepest_penetration(const std::vector<Pose>& X_OL, const HandProximity* known = nullptr) const;

  /// Lower bound [m] of the distance between a link and the object; exact below `exact_below` (from meshes).
  /// 0: they intersect.
  double distance_to_object(int link, const Pose& X_OL, double exact_below, PairHint* hint = nullptr) const;
  double distance_to_obstacle(int obstacle, int link, const Pose& X_OL, double exact_below,
                              PairHint* hint = nullptr) const;
  double distance_of_links(int a, int b, const std::vector<Pose>& X_OL, double exact_below,
                           PairHint* hint = nullptr) const;

 private:
  void add_obstacles();
  bool link_hits_field(int link, const Pose& X_OL, const DistanceField& field) const;
  bool link_hits_obstacle(std::size_t obstacle, int link, const Pose& X_BL) const;
  bool links_hit(int a, int b, const std::vector<Pose>& X_OL) const;

  Scene scene_;
  Options options_;
  std::shared_ptr<const HandSurfaces> surfaces_;
  DistanceField object_field_;
  std::vector<DistanceField> obstacle_fields_;  ///< in the object frame's obstacle frames B
};

}  // namespace eigengrasp
