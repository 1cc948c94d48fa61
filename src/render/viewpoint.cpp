// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>

#include "ray_scene.hpp"

namespace eigengrasp {

namespace {

constexpr int kRaster = 48;           // rays along each side of the coarse picture
constexpr double kPointWeight = 1.5;  // of the points of interest against all items together
constexpr double kSteepLoss = 0.15;   // of a view straight from above, which tells little of heights

/// Rays of the coarse picture that meet each item.
std::vector<int> count_hits(const RayScene& rays, const Camera& camera, std::size_t n_items) {
  std::vector<int> counts(n_items, 0);
  const Vec3f eye = camera.position.cast<float>();
  for (int y = 0; y < kRaster; ++y) {
    for (int x0 = 0; x0 < kRaster; x0 += kLanes) {
      Rays packet;
      std::array<SurfaceHit, kLanes> hits;
      for (int i = 0; i < kLanes; ++i) {
        packet.origins[static_cast<std::size_t>(i)] = eye;
        packet.directions[static_cast<std::size_t>(i)] =
            camera.ray_direction(2.0 * (x0 + i + 0.5) / kRaster - 1.0, 1.0 - 2.0 * (y + 0.5) / kRaster)
                .cast<float>();
      }
      rays.trace_solids(packet, hits);
      for (const SurfaceHit& hit : hits)
        if (hit.item >= 0) ++counts[static_cast<std::size_t>(hit.item)];
    }
  }
  return counts;
}

/// Share of the points that are seen; a point counts as seen where nothing lies more than `slack` [m] in
/// front of it.
double share_seen(const RayScene& rays, const Camera& camera, std::span<const Vec3> points, double slack) {
  if (points.empty()) return 0.0;
  int seen = 0;
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    Rays packet;
    for (std::size_t i = 0; i < kLanes; ++i) {
      packet.active[i] = first + i < points.size();
      if (!packet.active[i]) continue;
      const Vec3 to_point = points[first + i] - camera.position;
      packet.origins[i] = camera.position.cast<float>();
      packet.directions[i] = to_point.normalized().cast<float>();
      packet.far[i] = static_cast<float>(to_point.norm() - slack);
    }
    const auto hidden = rays.occluded(packet);
    for (std::size_t i = 0; i < kLanes; ++i) seen += packet.active[i] && !hidden[i] ? 1 : 0;
  }
  return static_cast<double>(seen) / static_cast<double>(points.size());
}

}  // namespace

Vec3 pick_view(const RenderScene& scene, std::span<const Vec3> points_W, const Vec3& up) {
  const std::vector<Vec3> candidates = view_candidates(up);
  const Box box = scene.framed_box();
  if (box.empty()) return candidates.front();
  const RayScene rays(scene);
  const std::size_t n_items = scene.items().size();
  std::vector<std::vector<int>> counts;
  std::vector<double> scores;
  std::vector<int> most(n_items, 1);
  for (const Vec3& direction : candidates) {
    const Camera camera = frame_camera(box, direction, up);
    counts.push_back(count_hits(rays, camera, n_items));
    scores.push_back(kPointWeight * share_seen(rays, camera, points_W, 0.02 * box.diagonal()));
    for (std::size_t i = 0; i < n_items; ++i) most[i] = std::max(most[i], counts.back()[i]);
  }
  double weights = 1e-12;
  for (const RenderItem& item : scene.items()) weights += item.interest;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (std::size_t i = 0; i < n_items; ++i)
      scores[c] += scene.items()[i].interest / weights * counts[c][i] / most[i];
  scores.back() -= kSteepLoss;
  // A tie within rounding goes to the earlier candidate.
  std::size_t best = 0;
  for (std::size_t c = 1; c < candidates.size(); ++c)
    if (scores[c] > scores[best] + 1e-9) best = c;
  return candidates[best];
}

}  // namespace eigengrasp
