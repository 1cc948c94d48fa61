// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Free times of whole parts of surfaces, without their triangles.
#include <algorithm>
#include <cmath>

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "geometry/moving_boxes.hpp"

namespace eigengrasp {

double compute_rough_free_time(const DistanceField& field, const MeshBvh& b, const Pose& X_AB,
                               const SurfaceMotion& motion, double margin, double horizon) {
  if (b.empty()) return horizon;
  constexpr double small = 0.002;  // [m] smaller parts tell hardly more, beside the error of the field
  const detail::PosedBoxes posed(b, b, X_AB);
  const Vec3 middle = X_AB * b.box().center();
  double speed = 0.0;  // of the middle
  double spin = 0.0;
  for (const Screw& s : motion.of_b) {
    speed += s.velocity(middle).norm();
    spin += s.angular.norm();
  }
  struct Part {
    int node;
    double gap;
    double speed;
    double radius;
  };
  const auto look = [&](int node) {
    const auto [at, radius] = posed.ball(node);
    const Vec3 center(at[0], at[1], at[2]);
    return Part{node, certain_distance(field, center) - radius - margin,
                speed + spin * ((center - middle).norm() + radius), radius};
  };
  double best = horizon;
  const auto matters = [&](const Part& part) {
    return part.gap <= 0.0 || part.gap < best * (part.speed + 0.5 * motion.acceleration * best);
  };
  Part stack[128];
  int top = 0;
  stack[top++] = look(0);
  while (top > 0) {
    const Part part = stack[--top];
    if (!matters(part)) continue;
    const MeshBvh::Node& n = b.nodes()[static_cast<std::size_t>(part.node)];
    if (n.count > 0 || part.radius < small) {
      best = std::min(best, time_to_close(part.gap, part.speed, motion.acceleration));
      if (best == 0.0) break;
      continue;
    }
    Part near = look(n.left);
    Part far = look(n.left + 1);
    if (far.gap < near.gap) std::swap(near, far);
    if (matters(far)) stack[top++] = far;
    if (matters(near)) stack[top++] = near;
  }
  return best;
}

double compute_rough_free_time(const MeshBvh& a, const Pose& X_OA, const MeshBvh& b, const Pose& X_OB,
                               const SurfaceMotion& motion, double margin, double enough) {
  constexpr int most_pairs = 16;  // beyond, the triangles themselves tell more
  double best = std::numeric_limits<double>::infinity();
  if (a.empty() || b.empty()) return best;
  const detail::PosedBoxes posed_a(a, a, X_OA);
  const detail::PosedBoxes posed_b(b, b, X_OB);
  const detail::MovingBoxes moving(motion);
  struct NodePair {
    int a;
    int b;
  };
  NodePair stack[2 * most_pairs + 2];
  int top = 0;
  int looks = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const NodePair pair = stack[--top];
    const detail::TurnedBox box_a = posed_a.box(pair.a);
    const detail::TurnedBox box_b = posed_b.box(pair.b);
    const double time = moving.time_apart(box_a, box_b, margin, motion.acceleration);
    if (time >= best) continue;
    const MeshBvh::Node& na = a.nodes()[static_cast<std::size_t>(pair.a)];
    const MeshBvh::Node& nb = b.nodes()[static_cast<std::size_t>(pair.b)];
    if (time >= enough || ++looks > most_pairs || (na.count > 0 && nb.count > 0)) {
      best = time;
      continue;
    }
    const bool split_a =
        nb.count > 0 || (na.count == 0 && detail::largest(box_a.half) >= detail::largest(box_b.half));
    for (int child = 0; child < 2; ++child)
      stack[top++] = split_a ? NodePair{na.left + child, pair.b} : NodePair{pair.a, nb.left + child};
  }
  return best;
}

}  // namespace eigengrasp
