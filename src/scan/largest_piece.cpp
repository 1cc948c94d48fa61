// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "scan/largest_piece.hpp"

#include <algorithm>
#include <numeric>

namespace eigengrasp {

void keep_largest_piece(TriangleMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    auto at = [&](std::int32_t i) -> std::int32_t& { return parent[static_cast<std::size_t>(i)]; };
    while (at(v) != v) v = at(v) = at(at(v));
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (const std::size_t k : {1U, 2U}) parent[static_cast<std::size_t>(root(t[k]))] = root(t[0]);
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[static_cast<std::size_t>(root(mesh.triangles[t][0]))] += area_normal(mesh, t).norm();
  const auto largest = static_cast<std::int32_t>(std::max_element(area.begin(), area.end()) - area.begin());
  std::erase_if(mesh.triangles, [&](const auto& t) { return root(t[0]) != largest; });
  weld(mesh, 0.0);  // drops what no triangle uses
}

}  // namespace eigengrasp
