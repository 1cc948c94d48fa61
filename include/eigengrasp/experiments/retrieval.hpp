// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/shape/nearest_shapes.hpp"

namespace eigengrasp {

/// How well neighbours are of the same class (Shilane et al. 2004, section 4): means over all queries, each
/// of which is one shape against all others. All in [0, 1].
struct RetrievalMeasures {
  double nearest_neighbor = 0.0;  ///< share of queries whose nearest shape is of their class
  double first_tier = 0.0;        ///< recall among the C - 1 nearest ones, C the size of the class
  double second_tier = 0.0;       ///< recall among the 2 (C - 1) nearest ones
  double e_measure = 0.0;         ///< 2 / (1 / precision + 1 / recall) of the 32 nearest ones
  double dcg = 0.0;  ///< discounted cumulative gain: 1 for rank 1, 1 / log2(i) for rank i, over the best
  std::vector<double> precision;  ///< at recall 5 %, 10 %, ..., 100 %
  int queries = 0;                ///< shapes in classes of three or more
};

/// @param classes a number for each shape's class; shapes that are alone or in a pair are no queries, as in
/// the benchmark's own program. @pre as many classes as shapes
RetrievalMeasures measure_retrieval(const NearestShapes& shapes, const std::vector<int>& classes);

}  // namespace eigengrasp
