// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "eigengrasp/core/pose.hpp"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

namespace eigengrasp::testing {

/// Least distance from the origin to a facet of the convex hull, 0 where the origin is not inside or the hull
/// is flat: the whole hull by Qhull, an independent way to epsilon.
inline double epsilon_by_qhull(std::span<const Vec6> wrenches) {
  if (wrenches.size() < 7) return 0.0;
  std::vector<double> coordinates;
  for (const Vec6& w : wrenches) coordinates.insert(coordinates.end(), w.data(), w.data() + 6);
  FILE* silent = std::fopen("/dev/null", "w");
  qhT qhull;
  qh_zero(&qhull, silent);
  char command[] = "qhull Qt Qx Q12 Pp";
  double epsilon = std::numeric_limits<double>::infinity();
  if (qh_new_qhull(&qhull, 6, static_cast<int>(wrenches.size()), coordinates.data(), False, command, nullptr,
                   silent) == 0) {
    for (const facetT* f = qhull.facet_list; f != nullptr && f->next != nullptr; f = f->next) {
      epsilon = std::min(epsilon, -f->offset);
    }
  } else {
    epsilon = 0.0;
  }
  qhull.NOerrexit = True;
  qh_freeqhull(&qhull, !qh_ALL);
  int n_blocks = 0;
  int n_bytes = 0;
  qh_memfreeshort(&qhull, &n_blocks, &n_bytes);
  std::fclose(silent);
  return std::max(0.0, epsilon);
}

}  // namespace eigengrasp::testing
