// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "eigengrasp/core/pose.hpp"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

namespace eigengrasp::testing {

/// Runs Qhull silently; what it made is given to `use` where it succeeds, and freed afterwards.
template <typename Use>
void with_qhull(std::span<const Vec6> wrenches, std::string command, const Use& use) {
  std::vector<double> coordinates;
  for (const Vec6& w : wrenches) coordinates.insert(coordinates.end(), w.data(), w.data() + 6);
  FILE* silent = std::fopen("/dev/null", "w");
  qhT qhull;
  qh_zero(&qhull, silent);
  if (qh_new_qhull(&qhull, 6, static_cast<int>(wrenches.size()), coordinates.data(), False, command.data(),
                   nullptr, silent) == 0)
    use(qhull);
  qhull.NOerrexit = True;
  qh_freeqhull(&qhull, !qh_ALL);
  int n_blocks = 0;
  int n_bytes = 0;
  qh_memfreeshort(&qhull, &n_blocks, &n_bytes);
  std::fclose(silent);
}

/// Least support value of the wrenches over the normals of the facets that Qhull finds, infinity where it
/// fails. Never below the true distance, and equal to it where the hull is right.
inline double least_support_by_qhull(std::span<const Vec6> wrenches, const std::string& command) {
  double least = std::numeric_limits<double>::infinity();
  with_qhull(wrenches, command, [&](const qhT& qhull) {
    for (const facetT* f = qhull.facet_list; f != nullptr && f->next != nullptr; f = f->next) {
      if (-f->offset > least + 1e-6) continue;
      double support = std::numeric_limits<double>::lowest();
      for (const Vec6& w : wrenches) support = std::max(support, Eigen::Map<const Vec6>(f->normal).dot(w));
      least = std::min(least, support);
    }
  });
  return least;
}

/// Distance from the origin to the boundary of the convex hull of wrenches, 0 where the origin is not inside,
/// by the whole hull: an independent way to epsilon. Two hulls, since Qhull's merging of facets (exact, but
/// wrong or failing where many wrenches are coplanar or nearly repeated) and its joggle (always right to
/// about 1e-9) complement each other.
inline double epsilon_by_qhull(std::span<const Vec6> wrenches) {
  if (wrenches.size() < 7) return 0.0;
  const double merged = least_support_by_qhull(wrenches, "qhull Qt Q12 C-1e-10 Pp");
  const double joggled = least_support_by_qhull(wrenches, "qhull QJ1e-10 Pp");
  const double least = std::min(merged, joggled);
  return least < std::numeric_limits<double>::infinity() ? std::max(0.0, least) : 0.0;
}

/// Volume of the convex hull of wrenches, joggled by 1e-10; 0 where Qhull fails.
inline double volume_by_qhull(std::span<const Vec6> wrenches) {
  double volume = 0.0;
  with_qhull(wrenches, "qhull QJ1e-10 Pp FA", [&](const qhT& qhull) { volume = qhull.totvol; });
  return volume;
}

}  // namespace eigengrasp::testing
