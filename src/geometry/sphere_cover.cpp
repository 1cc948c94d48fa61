// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/sphere_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace eigengrasp {

namespace {
constexpr std::size_t most_candidates = 1500;  // balls to choose from
}

SurfaceSamples sample_surface(const TriangleMesh& mesh, double spacing) {
  SurfaceSamples samples;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = area_normal(mesh, t);
    if (!(normal.norm() > 0.0)) continue;
    const Vec3& a = mesh.corner(t, 0);
    const Vec3 ab = mesh.corner(t, 1) - a;
    const Vec3 ac = mesh.corner(t, 2) - a;
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
    for (int i = 0; i < n; ++i)  // centres of the n^2 equal sub-triangles that point up or down
      for (int j = 0; j < n - i; ++j)
        for (double third : {1.0 / 3.0, 2.0 / 3.0}) {
          if (third > 0.5 && j == n - i - 1) continue;
          samples.points.push_back(a + (i + third) / n * ab + (j + third) / n * ac);
          samples.normals.push_back(normal.normalized());
        }
  }
  return samples;
}

namespace {

/// Largest ball inside the surface that touches it at p; radius 0 where none was found.
Sphere medial_ball(const MeshBvh& bvh, const Vec3& p, const Vec3& n, double largest) {
  double r = largest;
  for (int i = 0; i < 40; ++i) {
    const Vec3 c = p - r * n;
    const ClosestPoint q = bvh.closest_point(c, r * (1.0 - 1e-6) - 1e-7);
    if (q.triangle < 0) return {c, r};
    const Vec3 d = p - q.point;
    const double along = 2.0 * n.dot(d);
    if (!(along > 1e-12)) return {};
    const double smaller = d.squaredNorm() / along;
    if (!(smaller < r)) return {c, q.distance};
    r = smaller;
  }
  return {p - r * n, r};
}

/// Keeps one sample in each cell of the given size, the first.
SurfaceSamples thin_out(const SurfaceSamples& samples, double cell) {
  SurfaceSamples kept;
  std::set<std::array<long, 4>> taken;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const Vec3& p = samples.points[i];
    Eigen::Index axis = 0;  // the two sides of a thin plate are not one
    samples.normals[i].cwiseAbs().maxCoeff(&axis);
    const long side = samples.normals[i][axis] < 0.0 ? -1 - axis : 1 + axis;
    if (!taken.insert({std::lround(p.x() / cell), std::lround(p.y() / cell), std::lround(p.z() / cell), side})
             .second)
      continue;
    kept.points.push_back(p);
    kept.normals.push_back(samples.normals[i]);
  }
  return kept;
}

struct Candidate {
  Sphere ball;
  std::vector<int> reaches;  ///< samples within the tolerance
};

std::vector<int> reached_samples(const Sphere& ball, double tolerance, const std::vector<Vec3>& points) {
  std::vector<int> reached;
  const double reach2 = (ball.radius + tolerance) * (ball.radius + tolerance);
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - ball.center).squaredNorm() <= reach2) reached.push_back(static_cast<int>(i));
  return reached;
}

/// Greedy set cover with lazily updated gains.
std::vector<Sphere> choose(std::vector<Candidate>& candidates, std::size_t n_samples) {
  const auto fewer = [](const std::pair<int, int>& a, const std::pair<int, int>& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::vector<std::pair<int, int>> heap;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    heap.emplace_back(static_cast<int>(candidates[i].reaches.size()), static_cast<int>(i));
  std::make_heap(heap.begin(), heap.end(), fewer);
  std::vector<bool> reached(n_samples, false);
  std::vector<Sphere> chosen;
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), fewer);
    const auto [promised, index] = heap.back();
    heap.pop_back();
    const Candidate& c = candidates[static_cast<std::size_t>(index)];
    const auto gain = static_cast<int>(std::count_if(
        c.reaches.begin(), c.reaches.end(), [&](int s) { return !reached[static_cast<std::size_t>(s)]; }));
    if (gain == 0) continue;
    if (gain < promised) {
      heap.emplace_back(gain, index);
      std::push_heap(heap.begin(), heap.end(), fewer);
      continue;
    }
    for (int s : c.reaches) reached[static_cast<std::size_t>(s)] = true;
    chosen.push_back(c.ball);
  }
  return chosen;
}

}  // namespace

std::vector<Sphere> cover_with_inner_spheres(const TriangleMesh& mesh, const MeshBvh& bvh, double tolerance) {
  if (mesh.empty()) return {};
  const double spacing = std::max(0.0012, std::sqrt(surface_area(mesh) / 3000.0));
  const SurfaceSamples samples = thin_out(sample_surface(mesh, spacing), spacing);
  const std::size_t stride = 1 + samples.points.size() / most_candidates;
  const double largest = 0.5 * bounding_box(mesh).diagonal();
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < samples.points.size(); i += stride) {
    Vec3 normal = samples.normals[i];
    const Vec3& p = samples.points[i];
    if (!bvh.contains(p - 1e-5 * normal)) {
      if (!bvh.contains(p + 1e-5 * normal)) continue;  // a surface inside the solid, or a loose sheet
      normal = -normal;
    }
    Sphere ball = medial_ball(bvh, p, normal, largest);
    if (ball.radius < tolerance || !bvh.contains(ball.center)) {
      ball.center = p - 0.5 * tolerance * normal;
      ball.radius = std::clamp(-bvh.signed_distance(ball.center), 0.0, 0.5 * tolerance);
    }
    candidates.push_back({ball, reached_samples(ball, tolerance, samples.points)});
  }
  std::vector<Sphere> spheres = choose(candidates, samples.points.size());
  std::stable_sort(spheres.begin(), spheres.end(),
                   [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
  return spheres;
}

namespace {

/// Ball about the middle of the spheres' box.
Sphere bound_of(const Sphere* spheres, int count) {
  Box box;
  for (int i = 0; i < count; ++i) {
    box.add(spheres[i].center - Vec3::Constant(spheres[i].radius));
    box.add(spheres[i].center + Vec3::Constant(spheres[i].radius));
  }
  Sphere bound{box.center(), 0.0};
  for (int i = 0; i < count; ++i)
    bound.radius = std::max(bound.radius, (spheres[i].center - bound.center).norm() + spheres[i].radius);
  return bound;
}

void split(std::vector<Sphere>& spheres, int first, int count, int group_size,
           std::vector<SphereGroup>& groups) {
  if (count <= group_size) {
    if (count > 0) groups.push_back({bound_of(spheres.data() + first, count), first, count});
    return;
  }
  Box centers;
  for (int i = first; i < first + count; ++i) centers.add(spheres[static_cast<std::size_t>(i)].center);
  Eigen::Index axis = 0;
  centers.size().maxCoeff(&axis);
  const auto begin = spheres.begin() + first;
  std::stable_sort(begin, begin + count,
                   [axis](const Sphere& a, const Sphere& b) { return a.center[axis] < b.center[axis]; });
  const int half = count / 2;
  split(spheres, first, half, group_size, groups);
  split(spheres, first + half, count - half, group_size, groups);
}

}  // namespace

std::vector<SphereGroup> group_spheres(std::vector<Sphere>& spheres, int group_size) {
  std::vector<SphereGroup> groups;
  split(spheres, 0, static_cast<int>(spheres.size()), group_size, groups);
  return groups;
}

Sphere bounding_sphere(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  const auto farthest_from = [&](const Vec3& p) {
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - p).squaredNorm() < (b - p).squaredNorm();
    });
  };
  const Vec3 a = farthest_from(points.front());
  const Vec3 b = farthest_from(a);
  Sphere ball{0.5 * (a + b), 0.5 * (a - b).norm()};
  for (const Vec3& p : points) {
    const double d = (p - ball.center).norm();
    if (d <= ball.radius) continue;
    const double r = 0.5 * (ball.radius + d);
    ball.center += (d - r) / d * (p - ball.center);
    ball.radius = r;
  }
  for (const Vec3& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  return ball;
}

}  // namespace eigengrasp
