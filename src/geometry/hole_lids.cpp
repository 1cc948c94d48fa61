// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "geometry/hole_lids.hpp"

#include <cstdlib>
#include <map>
#include <vector>

namespace eigengrasp {

namespace {

/// Where the edges without a neighbour lead to, from each vertex, so that lids along them run the right way.
/// As many lead to a vertex as from it, since that holds for each triangle.
using OpenEdges = std::map<std::int32_t, std::vector<std::int32_t>>;

OpenEdges find_open_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> surplus;  // of the way from the lower to the higher
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k];
      const std::int32_t b = t[(k + 1) % 3];
      if (a < b) {
        ++surplus[{a, b}];
      } else {
        --surplus[{b, a}];
      }
    }
  OpenEdges open;
  for (const auto& [edge, count] : surplus) {
    if (count == 0) continue;
    const auto [from, to] = count > 0 ? std::pair(edge.second, edge.first) : edge;
    open[from].insert(open[from].end(), static_cast<std::size_t>(std::abs(count)), to);
  }
  return open;
}

/// Takes a loop out of the edges that passes no vertex twice.
std::vector<std::int32_t> take_loop(OpenEdges& open) {
  std::vector<std::int32_t> way{open.begin()->first};
  std::map<std::int32_t, std::size_t> place{{way.front(), 0}};
  for (;;) {
    const std::int32_t next = open.at(way.back()).back();
    const auto passed = place.find(next);
    if (passed != place.end()) {
      way.erase(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(passed->second));
      break;
    }
    place[next] = way.size();
    way.push_back(next);
  }
  for (const std::int32_t v : way) {
    open[v].pop_back();
    if (open[v].empty()) open.erase(v);
  }
  return way;
}

}  // namespace

TriangleMesh make_hole_lids(const TriangleMesh& mesh) {
  TriangleMesh surface = mesh;
  weld(surface, 1e-6);
  TriangleMesh lids;
  for (OpenEdges open = find_open_edges(surface); !open.empty();) {
    const auto loop = take_loop(open);
    const auto first = static_cast<std::int32_t>(lids.vertices.size());
    const auto n = static_cast<std::int32_t>(loop.size());
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : loop) {
      lids.vertices.push_back(surface.vertices[static_cast<std::size_t>(v)]);
      middle += lids.vertices.back() / n;
    }
    lids.vertices.push_back(middle);
    for (std::int32_t k = 0; k < n; ++k)
      lids.triangles.push_back({first + k, first + (k + 1) % n, first + n});
  }
  return lids;
}

}  // namespace eigengrasp
