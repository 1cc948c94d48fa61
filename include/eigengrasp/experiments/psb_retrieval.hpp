// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/result_picture.hpp"
#include "eigengrasp/experiments/retrieval.hpp"

namespace eigengrasp {

struct PsbRetrievalOptions {
  std::filesystem::path psb;   ///< folder of the Princeton Shape Benchmark
  bool solid = true;           ///< descriptors of the solid as well, for comparison; most of the time
  std::size_t index_size = 0;  ///< descriptors for the measurement of ShapeIndex; 0: none
  int threads = 0;             ///< 0: all; does not change the result
  const StopFlag* stop = nullptr;
  std::function<void(double share, const std::string& next)> progress;
};

/// One way to describe shapes, on one half of the benchmark.
struct RetrievalRow {
  std::string name;
  bool test = false;
  int moments = 0, voxels = 0;  ///< models by route
  int failed = 0;        ///< models that could not be described that way; they count as unlike all others
  double seconds = 0.0;  ///< median processor time of a descriptor
  RetrievalMeasures measures;
};

/// How quickly neighbours are found.
struct SearchTimes {
  std::size_t exact_size = 0;  ///< descriptors in the exact search
  double exact_seconds = 0.0;  ///< median of a query for 25 neighbours
  std::size_t index_size = 0;  ///< 0: not measured
  double build_seconds = 0.0;
  struct Width {
    std::size_t width = 0;
    double seconds = 0.0;  ///< median of a query for 25 neighbours
    double recall = 0.0;   ///< share of the 25 nearest ones that is found
  };
  std::vector<Width> widths;
};

struct PsbRetrieval {
  std::vector<RetrievalRow> rows;  ///< the default descriptor on the test half first
  std::vector<int> absent;         ///< classified, but without a mesh
  SearchTimes search;
  bool stopped_early = false;
};

/// Describes all classified models and measures retrieval within the test and within the training half of the
/// base classification. Cost: 1 min of one core, 6 min with the solid, 0.4 ms a descriptor of the index.
/// @throws Error where the benchmark is not there or a mesh cannot be read
PsbRetrieval run_psb_retrieval(const PsbRetrievalOptions& options);

/// Times of the exact search among 7,256 descriptors and of the index, whose descriptors are mixtures of
/// three of the given ones each.
SearchTimes measure_search(const NearestShapes& shapes, std::size_t index_size, int threads);

std::string psb_retrieval_markdown(const PsbRetrieval& result, const ExperimentRecord& record);
std::string psb_retrieval_json(const PsbRetrieval& result, const ExperimentRecord& record);
/// The precision-recall plot as SVG, and as a picture.
std::string psb_retrieval_svg(const PsbRetrieval& result);
Image psb_retrieval_picture(const PsbRetrieval& result);

/// The spherical harmonics descriptor on the test half (Shilane et al. 2004, Table 4): nearest neighbour,
/// first and second tier, E-measure, DCG.
inline constexpr double kSphericalHarmonics[5] = {0.556, 0.309, 0.411, 0.241, 0.584};

}  // namespace eigengrasp
