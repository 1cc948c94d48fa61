// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/experiments/psb_retrieval.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "eigengrasp/shape/shape_index.hpp"

namespace eigengrasp {

namespace {

constexpr std::size_t graspable_objects = 7256;  // of the Columbia Grasp Database
constexpr std::size_t neighbors = 25;
constexpr std::uint64_t mixture_key = 1, query_key = 2;

/// A random mixture of three descriptors, of length 1.
std::vector<float> mixture(const NearestShapes& shapes, RandomStream& stream) {
  std::vector<double> sum(shapes.dimension());
  for (int k = 0; k < 3; ++k) {
    const auto pick = static_cast<std::size_t>(stream.uniform() * static_cast<double>(shapes.size()));
    const std::vector<float> part = shapes.descriptor(pick);
    const double share = stream.uniform();
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * part[i];
  }
  double squared = 0.0;
  for (const double x : sum) squared += x * x;
  std::vector<float> mixed;
  for (const double x : sum) mixed.push_back(static_cast<float>(x / std::sqrt(squared)));
  return mixed;
}

NearestShapes mixtures(const NearestShapes& shapes, std::size_t count, std::uint64_t key) {
  NearestShapes mixed(shapes.dimension());
  RandomStream stream{key};
  while (mixed.size() < count) mixed.add(mixture(shapes, stream));
  return mixed;
}

using Found = std::vector<std::vector<NearShape>>;

/// What a search finds for all queries; returns the median of its time.
template <class Search>
double timed(const NearestShapes& queries, Found& found, const Search& search) {
  std::vector<double> seconds;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const std::vector<float> query = queries.descriptor(i);
    const StopWatch watch;
    found.push_back(search(query));
    seconds.push_back(watch.seconds());
  }
  return median(seconds);
}

double recall(const Found& found, const Found& exact) {
  std::size_t hits = 0, all = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    for (const NearShape& near : exact[i]) {
      ++all;
      hits +=
          static_cast<std::size_t>(std::any_of(found[i].begin(), found[i].end(), [&](const NearShape& other) {
            return other.index == near.index;
          }));
    }
  return static_cast<double>(hits) / static_cast<double>(all);
}

void measure_index(const NearestShapes& shapes, const NearestShapes& queries, int threads,
                   SearchTimes& times) {
  Found exact;
  timed(queries, exact, [&](const auto& query) { return shapes.find_nearest(query, neighbors); });
  ShapeIndexOptions options;
  options.threads = threads;
  const StopWatch watch;
  const ShapeIndex index(shapes, options);
  times.build_seconds = watch.seconds();
  times.index_size = shapes.size();
  for (const std::size_t width : {50U, 100U, 200U, 400U}) {
    Found found;
    const double seconds =
        timed(queries, found, [&](const auto& query) { return index.find_nearest(query, neighbors, width); });
    times.widths.push_back({width, seconds, recall(found, exact)});
  }
}

}  // namespace

SearchTimes measure_search(const NearestShapes& shapes, std::size_t index_size, int threads) {
  if (shapes.size() == 0) fail("there is no descriptor to search among, expected at least one");
  SearchTimes times;
  times.exact_size = graspable_objects;
  const NearestShapes queries = mixtures(shapes, 200, query_key);
  const NearestShapes few = mixtures(shapes, graspable_objects, mixture_key);
  Found found;
  times.exact_seconds =
      timed(queries, found, [&](const auto& query) { return few.find_nearest(query, neighbors); });
  if (index_size > 0) measure_index(mixtures(shapes, index_size, mixture_key), queries, threads, times);
  return times;
}

}  // namespace eigengrasp
