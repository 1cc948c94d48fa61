// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/retrieval.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eigengrasp {

namespace {

constexpr int recalls = 20;
constexpr std::size_t e_length = 32;

/// Whether the shapes that are nearest to a query, itself left out, are of its class.
std::vector<bool> ranked_hits(const NearestShapes& shapes, const std::vector<int>& classes,
                              std::size_t query) {
  std::vector<bool> hits;
  for (const NearShape& near : shapes.find_nearest(shapes.descriptor(query), shapes.size()))
    if (near.index != query) hits.push_back(classes[near.index] == classes[query]);
  return hits;
}

double gain(std::size_t rank) {  // from 1
  return rank == 1 ? 1.0 : 1.0 / std::log2(static_cast<double>(rank));
}

/// Adds one query's measures; `others` are the shapes of its class but for itself.
void add_query(RetrievalMeasures& sum, const std::vector<bool>& hits, std::size_t others) {
  const double all = static_cast<double>(others);
  const auto found_in = [&](std::size_t length) {
    const auto end = hits.begin() + static_cast<std::ptrdiff_t>(std::min(length, hits.size()));
    return static_cast<double>(std::count(hits.begin(), end, true));
  };
  sum.nearest_neighbor += hits.front() ? 1.0 : 0.0;
  sum.first_tier += found_in(others) / all;
  sum.second_tier += found_in(2 * others) / all;
  const std::size_t length = std::min(e_length, hits.size());
  sum.e_measure += 2.0 * found_in(length) / (static_cast<double>(length) + all);
  double gained = 0.0, best = 0.0;
  for (std::size_t rank = 1; rank <= hits.size(); ++rank)
    if (hits[rank - 1]) gained += gain(rank);
  for (std::size_t rank = 1; rank <= others; ++rank) best += gain(rank);
  sum.dcg += gained / best;
  std::size_t found = 0;
  int recall = 0;
  for (std::size_t rank = 1; rank <= hits.size() && recall < recalls; ++rank) {
    if (hits[rank - 1]) ++found;
    for (; recall < recalls && recalls * found >= static_cast<std::size_t>(recall + 1) * others; ++recall)
      sum.precision[static_cast<std::size_t>(recall)] +=
          static_cast<double>(found) / static_cast<double>(rank);
  }
  ++sum.queries;
}

}  // namespace

RetrievalMeasures measure_retrieval(const NearestShapes& shapes, const std::vector<int>& classes) {
  if (classes.size() != shapes.size()) throw std::logic_error("a class for each shape is needed");
  RetrievalMeasures mean;
  mean.precision.assign(recalls, 0.0);
  for (std::size_t query = 0; query < classes.size(); ++query) {
    const auto members = static_cast<std::size_t>(std::count(classes.begin(), classes.end(), classes[query]));
    if (members > 2) add_query(mean, ranked_hits(shapes, classes, query), members - 1);
  }
  const double count = std::max(1, mean.queries);
  for (double* value :
       {&mean.nearest_neighbor, &mean.first_tier, &mean.second_tier, &mean.e_measure, &mean.dcg})
    *value /= count;
  for (double& precision : mean.precision) precision /= count;
  return mean;
}

}  // namespace eigengrasp
