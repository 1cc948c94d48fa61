// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/grasp/collision_model.hpp"

#include <algorithm>
#include <stdexcept>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/geometry/mesh_motion.hpp"
#include "eigengrasp/grasp/hand_proximity.hpp"

namespace eigengrasp {

const char* describe(Legality legality) {
  switch (legality) {
    case Legality::legal:
      return "is legal";
    case Legality::hits_object:
      return "collides with the object";
    case Legality::hits_itself:
      return "collides with itself";
    case Legality::hits_obstacle:
      return "collides with an obstacle";
  }
  throw std::logic_error("unknown legality");
}

namespace {

DistanceField make_field(const TriangleMesh& mesh, const MeshBvh& bvh, const DistanceFieldOptions& options,
                         PreparationCache* cache) {
  return cache != nullptr ? cache->field(mesh, bvh, options) : DistanceField(bvh, options);
}

}  // namespace

HandSurfaces::HandSurfaces(const HandModel& hand, double cover_tolerance, int threads,
                           PreparationCache* cache)
    : links(hand.links.size()) {
  parallel_for(links.size(), threads, [&](std::size_t i, int) {
    const TriangleMesh& mesh = hand.links[i].mesh;
    if (mesh.empty()) return;
    links[i].bvh = MeshBvh(mesh);
    links[i].bound = bounding_sphere(mesh.vertices);
    if (cover_tolerance <= 0.0) return;
    links[i].inner_spheres = cache != nullptr ? cache->inner_spheres(mesh, links[i].bvh, cover_tolerance)
                                              : cover_with_inner_spheres(mesh, links[i].bvh, cover_tolerance);
    links[i].cover = BallCover(cache != nullptr ? cache->holding_spheres(mesh, links[i].bvh, cover_tolerance)
                                                : grow_to_hold(links[i].bvh, links[i].inner_spheres));
    links[i].groups = group_spheres(links[i].inner_spheres, 8);
    DistanceFieldOptions field;
    field.cell = 0.0015;
    field.margin = 0.008;
    field.far_margin = 0.032;
    field.threads = 1;
    links[i].field = make_field(mesh, links[i].bvh, field, cache);
  });
}

CollisionModel::CollisionModel(Scene scene, const Options& options)
    : scene_(std::move(scene)),
      options_(options),
      surfaces_(std::make_shared<const HandSurfaces>(
          *scene_.hand, options.fast ? options.cover_tolerance : 0.0, options.threads, options.cache.get())) {
  if (!options.fast) return;
  DistanceFieldOptions field;
  field.threads = options.threads;
  object_field_ = make_object_field(*scene_.object, field, options.cache.get());
  add_obstacles();
}

CollisionModel::CollisionModel(Scene scene, const Options& options, Prepared prepared)
    : scene_(std::move(scene)),
      options_(options),
      surfaces_(std::move(prepared.hand)),
      object_field_(std::move(prepared.object)) {
  if (options.fast) add_obstacles();
}

void CollisionModel::add_obstacles() {
  for (const Obstacle& obstacle : scene_.obstacles) {
    // Only the part near the object can matter.
    DistanceFieldOptions clipped;
    clipped.threads = options_.threads;
    const Pose X_BO = obstacle.X_OB.inverse();
    const Vec3 center = X_BO * scene_.object->mesh.vertices.front();
    const double reach = bounding_box(scene_.object->mesh).diagonal() + 2.0 * hand_reach(*scene_.hand);
    clipped.region = {center - Vec3::Constant(reach), center + Vec3::Constant(reach)};
    clipped.cell = 0.005;
    clipped.far_margin = reach;
    obstacle_fields_.push_back(
        make_field(obstacle.model->mesh, obstacle.model->bvh, clipped, options_.cache.get()));
  }
}

namespace {

bool spheres_apart(const Sphere& a, const Sphere& b, const Pose& X_AB) {
  const double reach = a.radius + b.radius;
  return (a.center - X_AB * b.center).squaredNorm() > reach * reach;
}

bool box_apart(const Box& box, const Sphere& s) {
  const Vec3 outside = (box.min - s.center).cwiseMax(s.center - box.max).cwiseMax(Vec3::Zero());
  return outside.squaredNorm() > s.radius * s.radius;
}

Sphere moved(const Sphere& s, const Pose& X) {
  return {X * s.center, s.radius};
}

/// Whether a point is inside a solid. Where no surface is within the diagonal of a cell of the field, the
/// field has the same sign.
bool inside(const MeshBvh& solid, const DistanceField& field, const Vec3& p) {
  if (!solid.box().contains(p)) return false;
  const bool certain =
      !field.empty() && certain_distance(field, p) > 1.75 * field.scale() * field.fine().cell;
  return certain ? field.distance(p) < 0.0 : solid.contains(p);
}

/// Whether a clearance [m] that is known of two surfaces rules out that they cross, rounding and all.
bool rules_out_crossing(double clearance) {
  return clearance > 1e-6;
}

/// A surface that crosses no other is inside it where any of its points is. @param field of the solid, or
/// empty @param clearance that is known, or 0
CollisionModel::ObjectOverlap overlap(const MeshBvh& solid, const DistanceField& field,
                                      const HandSurfaces::LinkSurface& link, const Pose& X_SL,
                                      double clearance = 0.0) {
  CollisionModel::ObjectOverlap result;
  if (link.empty() || box_apart(solid.box(), moved(link.bound, X_SL))) return result;
  result.crosses = !rules_out_crossing(clearance) && !link.cover.keeps_away(field, X_SL, 0.0) &&
                   intersects(solid, link.bvh, X_SL, field);
  if (!result.crosses)
    result.contained = inside(solid, field, X_SL * link.bvh.corners(0).a) ||
                       inside(link.bvh, link.field, X_SL.inverse() * solid.corners(0).a);
  return result;
}

}  // namespace

bool CollisionModel::link_hits_field(int link, const Pose& X_FL, const DistanceField& field) const {
  const auto& surface = surfaces_->links[static_cast<std::size_t>(link)];
  if (surface.empty()) return false;
  const double clearance = field.distance(X_FL * surface.bound.center);
  if (clearance > surface.bound.radius) return false;
  for (const SphereGroup& g : surface.groups) {
    // What the distance at the link's middle says of the group, before the field is asked again.
    if (clearance > (g.bound.center - surface.bound.center).norm() + g.bound.radius) continue;
    if (field.distance(X_FL * g.bound.center) > g.bound.radius) continue;
    for (int i = g.first; i < g.first + g.count; ++i) {
      const Sphere& s = surface.inner_spheres[static_cast<std::size_t>(i)];
      if (field.distance(X_FL * s.center) < s.radius - options_.refuse_depth) return true;
    }
  }
  return false;
}

// Only the part of an obstacle near the object has a field; beyond it the meshes are asked.
bool CollisionModel::link_hits_obstacle(std::size_t obstacle, int link, const Pose& X_BL) const {
  const auto& surface = surfaces_->links[static_cast<std::size_t>(link)];
  const DistanceField& field = obstacle_fields_[obstacle];
  if (surface.empty() || field.covers(X_BL * surface.bound.center)) return link_hits_field(link, X_BL, field);
  const ObjectOverlap o = overlap(scene_.obstacles[obstacle].model->bvh, field, surface, X_BL);
  return o.crosses || o.contained;
}

namespace {

bool meet(const Sphere& a, const Vec3& center_b, double radius_b) {
  const double reach = a.radius + radius_b;
  return reach > 0.0 && (a.center - center_b).squaredNorm() < reach * reach;
}

}  // namespace

bool CollisionModel::links_hit(int a, int b, const std::vector<Pose>& X_OL) const {
  const auto& sa = surfaces_->links[static_cast<std::size_t>(a)];
  const auto& sb = surfaces_->links[static_cast<std::size_t>(b)];
  const Pose& X_OA = X_OL[static_cast<std::size_t>(a)];
  const Pose& X_OB = X_OL[static_cast<std::size_t>(b)];
  const Vec3 cb_O = X_OB * sb.bound.center;
  const double reach = sa.bound.radius + sb.bound.radius;
  if ((X_OA * sa.bound.center - cb_O).squaredNorm() > reach * reach) return false;
  const Pose X_AB = X_OA.inverse() * X_OB;
  for (const SphereGroup& gb : sb.groups) {
    const Vec3 gb_A = X_AB * gb.bound.center;
    if (!meet(sa.bound, gb_A, gb.bound.radius)) continue;
    for (const SphereGroup& ga : sa.groups) {
      if (!meet(ga.bound, gb_A, gb.bound.radius)) continue;
      for (int j = gb.first; j < gb.first + gb.count; ++j) {
        const Sphere& t = sb.inner_spheres[static_cast<std::size_t>(j)];
        const Vec3 t_A = X_AB * t.center;
        for (int i = ga.first; i < ga.first + ga.count; ++i)
          if (meet(sa.inner_spheres[static_cast<std::size_t>(i)], t_A, t.radius - options_.refuse_depth))
            return true;
      }
    }
  }
  return false;
}

Legality CollisionModel::check_fast(const std::vector<Pose>& X_OL) const {
  const int n = static_cast<int>(X_OL.size());
  for (int i = 0; i < n; ++i)
    if (link_hits_field(i, X_OL[static_cast<std::size_t>(i)], object_field_)) return Legality::hits_object;
  for (std::size_t k = 0; k < obstacle_fields_.size(); ++k) {
    const Pose X_BO = scene_.obstacles[k].X_OB.inverse();
    for (int i = 0; i < n; ++i)
      if (link_hits_obstacle(k, i, X_BO * X_OL[static_cast<std::size_t>(i)])) return Legality::hits_obstacle;
  }
  for (const auto& [a, b] : scene_.hand->collision_pairs)
    if (links_hit(a, b, X_OL)) return Legality::hits_itself;
  return Legality::legal;
}

CollisionModel::ObjectOverlap CollisionModel::overlap_with_object(int link, const Pose& X_OL) const {
  return overlap(scene_.object->bvh, object_field_, surfaces_->links[static_cast<std::size_t>(link)], X_OL);
}

Legality CollisionModel::check_exact(const std::vector<Pose>& X_OL) const {
  for (std::size_t i = 0; i < X_OL.size(); ++i) {
    const ObjectOverlap o = overlap(scene_.object->bvh, object_field_, surfaces_->links[i], X_OL[i]);
    if (o.crosses || o.contained) return Legality::hits_object;
  }
  for (const Obstacle& obstacle : scene_.obstacles) {
    const Pose X_BO = obstacle.X_OB.inverse();
    for (std::size_t i = 0; i < X_OL.size(); ++i) {
      const ObjectOverlap o = overlap(obstacle.model->bvh, {}, surfaces_->links[i], X_BO * X_OL[i]);
      if (o.crosses || o.contained) return Legality::hits_obstacle;
    }
  }
  for (const auto& [a, b] : scene_.hand->collision_pairs) {
    const auto& sa = surfaces_->links[static_cast<std::size_t>(a)];
    const auto& sb = surfaces_->links[static_cast<std::size_t>(b)];
    const Pose X_AB = X_OL[static_cast<std::size_t>(a)].inverse() * X_OL[static_cast<std::size_t>(b)];
    if (!spheres_apart(sa.bound, sb.bound, X_AB) && !sb.cover.keeps_away(sa.field, X_AB, 0.0) &&
        intersects(sa.bvh, sb.bvh, X_AB))
      return Legality::hits_itself;
  }
  return Legality::legal;
}

namespace {

/// Deepest point of the samples of a mesh inside a solid.
double depth_of_points(const std::vector<Vec3>& points, const Pose& X_SP, const MeshBvh& solid) {
  double deepest = 0.0;
  for (const Vec3& p : points) {
    const Vec3 q = X_SP * p;
    if (!solid.box().contains(q)) continue;
    const double d = solid.closest_point(q).distance;
    if (d > deepest && solid.contains(q)) deepest = d;
  }
  return deepest;
}

std::vector<Vec3> depth_probes(const TriangleMesh& mesh) {
  std::vector<Vec3> points = mesh.vertices;
  const SurfaceSamples samples = sample_surface(mesh, 0.0015);
  points.insert(points.end(), samples.points.begin(), samples.points.end());
  return points;
}

double penetration(const MeshBvh& a, const TriangleMesh& mesh_a, const MeshBvh& b, const TriangleMesh& mesh_b,
                   const Pose& X_AB) {
  return std::max(depth_of_points(depth_probes(mesh_b), X_AB, a),
                  depth_of_points(depth_probes(mesh_a), X_AB.inverse(), b));
}

}  // namespace

double CollisionModel::deepest_penetration(const std::vector<Pose>& X_OL, const HandProximity* known) const {
  const HandModel& hand = *scene_.hand;
  const std::size_t n = X_OL.size();
  const auto clearance = [known](const std::vector<double> HandProximity::*of, std::size_t i) {
    return known != nullptr && i < (known->*of).size() ? (known->*of)[i] : 0.0;
  };
  double deepest = 0.0;
  const auto add = [&](const ObjectModel& solid, const DistanceField& field, std::size_t link,
                       const Pose& X_SL, double clear) {
    const ObjectOverlap o = overlap(solid.bvh, field, surfaces_->links[link], X_SL, clear);
    if (o.crosses || o.contained)
      deepest = std::max(deepest, penetration(solid.bvh, solid.mesh, surfaces_->links[link].bvh,
                                              hand.links[link].mesh, X_SL));
  };
  for (std::size_t i = 0; i < n; ++i) {
    add(*scene_.object, object_field_, i, X_OL[i], clearance(&HandProximity::object_clearance, i));
    for (std::size_t k = 0; k < scene_.obstacles.size(); ++k) {
      const Obstacle& o = scene_.obstacles[k];
      add(*o.model, {}, i, o.X_OB.inverse() * X_OL[i],
          clearance(&HandProximity::obstacle_clearance, k * n + i));
    }
  }
  for (std::size_t k = 0; k < hand.collision_pairs.size(); ++k) {
    if (rules_out_crossing(clearance(&HandProximity::pair_clearance, k))) continue;
    const auto a = static_cast<std::size_t>(hand.collision_pairs[k][0]);
    const auto b = static_cast<std::size_t>(hand.collision_pairs[k][1]);
    const Pose X_AB = X_OL[a].inverse() * X_OL[b];
    const auto& sa = surfaces_->links[a];
    const auto& sb = surfaces_->links[b];
    if (spheres_apart(sa.bound, sb.bound, X_AB) || !intersects(sa.bvh, sb.bvh, X_AB)) continue;
    deepest = std::max(deepest, penetration(sa.bvh, hand.links[a].mesh, sb.bvh, hand.links[b].mesh, X_AB));
  }
  return deepest;
}

double CollisionModel::distance_to_object(int link, const Pose& X_OL, double exact_below,
                                          PairHint* hint) const {
  const auto& s = surfaces_->links[static_cast<std::size_t>(link)];
  const MeshBvh& bvh = scene_.object->bvh;
  const double bound = bvh.closest_point(X_OL * s.bound.center).distance - s.bound.radius;
  if (bound > exact_below) return bound;
  return closest_pair(bvh, s.bvh, X_OL, exact_below, hint).distance;
}

double CollisionModel::distance_to_obstacle(int obstacle, int link, const Pose& X_OL, double exact_below,
                                            PairHint* hint) const {
  const auto& s = surfaces_->links[static_cast<std::size_t>(link)];
  const Obstacle& o = scene_.obstacles[static_cast<std::size_t>(obstacle)];
  const Pose X_BL = o.X_OB.inverse() * X_OL;
  const double bound = o.model->bvh.closest_point(X_BL * s.bound.center).distance - s.bound.radius;
  if (bound > exact_below) return bound;
  return closest_pair(o.model->bvh, s.bvh, X_BL, exact_below, hint).distance;
}

double CollisionModel::distance_of_links(int a, int b, const std::vector<Pose>& X_OL, double exact_below,
                                         PairHint* hint) const {
  const auto& sa = surfaces_->links[static_cast<std::size_t>(a)];
  const auto& sb = surfaces_->links[static_cast<std::size_t>(b)];
  const Pose X_AB = X_OL[static_cast<std::size_t>(a)].inverse() * X_OL[static_cast<std::size_t>(b)];
  const double bound = (sa.bound.center - X_AB * sb.bound.center).norm() - sa.bound.radius - sb.bound.radius;
  if (bound > exact_below) return bound;
  return closest_pair(sa.bvh, sb.bvh, X_AB, exact_below, hint).distance;
}

}  // namespace eigengrasp
