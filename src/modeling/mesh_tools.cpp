// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/modeling/mesh_tools.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/parallel.hpp"

namespace eigengrasp::modeling {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

constexpr std::size_t chunk = 256;

template <typename Work>
void for_each_vertex(const TriangleMesh& mesh, int n_threads, const Work& work) {
  const std::size_t n = mesh.vertices.size();
  parallel_for((n + chunk - 1) / chunk, n_threads, [&](std::size_t c, int) {
    for (std::size_t v = c * chunk; v < std::min(n, (c + 1) * chunk); ++v) work(v);
  });
}

/// Triangles around each vertex.
std::vector<std::vector<std::int32_t>> fans_of(const TriangleMesh& mesh) {
  std::vector<std::vector<std::int32_t>> fans(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t v : mesh.triangles[t]) fans[at(v)].push_back(static_cast<std::int32_t>(t));
  }
  return fans;
}

/// Along the gradient g, taken anew only where `renew`.
Vec3 projected(const Solid& solid, Vec3 p, Vec3 g, double max_step, int iterations, bool renew) {
  for (int i = 0; i < iterations; ++i) {
    const double d = solid(p);
    if (std::abs(d) < 1e-8) break;
    if (renew && i > 0) g = gradient(solid, p);
    const double g2 = g.squaredNorm();
    if (g2 < 1e-4) break;
    Vec3 step = -d / g2 * g;
    const double length = step.norm();
    if (length > max_step) step *= max_step / length;
    p += step;
  }
  return p;
}

/// True where v may go to p: no triangle around it turns over, and none becomes a sliver that was none.
bool keeps_shape(const TriangleMesh& mesh, const std::vector<std::int32_t>& fan, std::size_t v,
                 const Vec3& p) {
  for (const std::int32_t t : fan) {
    std::array<Vec3, 3> now, then;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t w = at(mesh.triangles[at(t)][k]);
      now[k] = mesh.vertices[w];
      then[k] = w == v ? p : now[k];
    }
    const Vec3 n0 = (now[1] - now[0]).cross(now[2] - now[0]),
               n1 = (then[1] - then[0]).cross(then[2] - then[0]);
    if (n0.dot(n1) < 0.3 * n0.norm() * n1.norm()) return false;
    const double after = triangle_quality(then[0], then[1], then[2]);
    if (after < 0.1 && after < triangle_quality(now[0], now[1], now[2])) return false;
  }
  return true;
}

/// Moves the vertices to their targets one after the other, where that keeps the triangles sound.
void apply(TriangleMesh& mesh, const std::vector<std::vector<std::int32_t>>& fans,
           const std::vector<Vec3>& targets) {
  for (std::size_t v = 0; v < targets.size(); ++v) {
    if (keeps_shape(mesh, fans[v], v, targets[v])) mesh.vertices[v] = targets[v];
  }
}

double worst_quality(const TriangleMesh& mesh, const std::vector<std::int32_t>& fan) {
  double worst = 1.0;
  for (const std::int32_t t : fan) {
    worst = std::min(worst,
                     triangle_quality(mesh.corner(at(t), 0), mesh.corner(at(t), 1), mesh.corner(at(t), 2)));
  }
  return worst;
}

/// Of the neighbours of the vertex at p; its triangles form one closed fan.
Vec3 mean_of_neighbours(const TriangleMesh& mesh, const std::vector<std::int32_t>& fan, const Vec3& p) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t t : fan) {
    for (int k = 0; k < 3; ++k) sum += mesh.corner(at(t), k);
  }
  const auto n = static_cast<double>(fan.size());
  return (sum - n * p) / (2.0 * n);  // each neighbour lies in two triangles
}

/// A point of the surface and the normal there; the normal is zero where there is none.
struct TangentPlane {
  Vec3 point, normal;
};

TangentPlane tangent_plane(const TriangleMesh& mesh, const Solid& solid, std::size_t t, double reach) {
  const Vec3 c = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
  const Vec3 q = projected(solid, c, gradient(solid, c), reach, 2, false);
  const Vec3 g = gradient(solid, q);
  return {q, g.norm() < 0.1 ? Vec3::Zero().eval() : g.normalized()};
}

/// Point that all tangent planes around vertex v share best, where they differ enough to say so.
Vec3 feature_point(const Solid& solid, const std::vector<TangentPlane>& planes,
                   const std::vector<std::int32_t>& fan, const Vec3& p, double reach) {
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (const std::int32_t t : fan) {
    const Vec3& n = planes[at(t)].normal;
    A += n * n.transpose();
    b += n * n.dot(planes[at(t)].point - p);
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(A);
  Vec3 move = Vec3::Zero();
  if (solver.eigenvalues()[1] < 0.1 * solver.eigenvalues()[2]) return p;  // one plane: no feature
  for (int k = 0; k < 3; ++k) {
    if (solver.eigenvalues()[k] < 0.1 * solver.eigenvalues()[2]) continue;
    move += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).dot(b) / solver.eigenvalues()[k];
  }
  const Vec3 target = p + move;
  return move.norm() <= reach && std::abs(solid(target)) < 0.02 * reach ? target : p;
}

}  // namespace

void project(TriangleMesh& mesh, const Solid& solid, double max_step, int iterations, int n_threads) {
  std::vector<Vec3> next(mesh.vertices.size());
  for_each_vertex(mesh, n_threads, [&](std::size_t v) {
    const Vec3& p = mesh.vertices[v];
    next[v] = projected(solid, p, gradient(solid, p), max_step, iterations, true);
  });
  apply(mesh, fans_of(mesh), next);
}

void relax(TriangleMesh& mesh, const Solid& solid, double max_step, int iterations, int n_threads,
           double below_quality) {
  const auto fans = fans_of(mesh);
  for (int i = 0; i < iterations; ++i) {
    std::vector<Vec3> next = mesh.vertices;
    for_each_vertex(mesh, n_threads, [&](std::size_t v) {
      if (fans[v].empty() || worst_quality(mesh, fans[v]) > below_quality) return;
      const Vec3 p = mesh.vertices[v];
      const Vec3 g = gradient(solid, p);
      Vec3 step = mean_of_neighbours(mesh, fans[v], p) - p;
      if (g.squaredNorm() > 1e-4) step -= g * (g.dot(step) / g.squaredNorm());
      const Vec3 q = projected(solid, p + 0.6 * step, g, max_step, 2, false);
      if ((q - p).norm() < 4.0 * max_step) next[v] = q;
    });
    apply(mesh, fans, next);
  }
}

void sharpen(TriangleMesh& mesh, const Solid& solid, double reach, int n_threads) {
  const auto fans = fans_of(mesh);
  const std::size_t n = mesh.triangles.size();
  std::vector<TangentPlane> planes(n);
  parallel_for((n + chunk - 1) / chunk, n_threads, [&](std::size_t c, int) {
    for (std::size_t t = c * chunk; t < std::min(n, (c + 1) * chunk); ++t) {
      planes[t] = tangent_plane(mesh, solid, t, reach);
    }
  });
  std::vector<Vec3> next(mesh.vertices.size());
  for_each_vertex(mesh, n_threads, [&](std::size_t v) {
    next[v] = feature_point(solid, planes, fans[v], mesh.vertices[v], reach);
  });
  apply(mesh, fans, next);
}

void save_obj(const TriangleMesh& mesh, const std::filesystem::path& file, int decimals,
              const std::string& comment) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  if (!comment.empty()) fmt::format_to(to, "# {}\n", comment);
  for (const Vec3& p : mesh.vertices) {
    fmt::format_to(to, "v {:.{}f} {:.{}f} {:.{}f}\n", p.x(), decimals, p.y(), decimals, p.z(), decimals);
  }
  for (const auto& t : mesh.triangles) fmt::format_to(to, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  write_file_atomically(file, fmt::to_string(out));
}

}  // namespace eigengrasp::modeling
