// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/result_picture.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// The four curves of Fig. 12 of the paper, in the order of its results.
inline constexpr std::array<const char*, 4> kFigure12Methods = {"class", "zernike", "random", "planner"};

struct Figure12Options {
  std::vector<std::shared_ptr<const HandModel>> hands;
  int neighbors = 5;
  int candidates = 0;  ///< pre-grasps of a neighbour at a scale; 0: all
  int every = 1;       ///< of the store's models the first and then each so many-th, >= 1
  int models = 0;      ///< at most; 0: all
  std::uint64_t seed = 1;
  int threads = 0;                      ///< 0: all; a model each. Does not change the curves
  std::filesystem::path progress_file;  ///< what is done is kept there, and taken from there; empty: not
  const StopFlag* stop = nullptr;
  std::function<void(double share, const std::string& what)> progress = {};

  /// All violations as sentences: name, value, bound.
  std::vector<std::string> validate() const;
};

/// Of a model, a hand and a method.
struct Figure12Run {
  std::vector<double> epsilons;  ///< of the distinct form-closed grasps, falling; at most kFigure12Ranks
  int distinct = 0;              ///< grasps
  int candidates = 0;            ///< pre-grasps; of the planner 0
  double seconds = 0.0;  ///< of a core: neighbours, alignments and rating; of the planner its unit of work
};

inline constexpr int kFigure12Ranks = 100;

struct Figure12Model {
  std::string name;
  double prepare_seconds = 0.0;                  ///< of a core: reading, shape
  std::vector<std::array<Figure12Run, 4>> runs;  ///< by hand, then method
};

struct Figure12Curve {
  std::vector<double> epsilon;  ///< of the n-th best grasp, mean over the models; 0 for one with fewer
  double distinct = 0.0;        ///< grasps a model, mean
  double candidates = 0.0;      ///< pre-grasps a model, mean
  double seconds = 0.0;         ///< a model, mean
  int without = 0;              ///< models without any grasp
};

struct Figure12 {
  std::vector<std::string> hands;
  std::vector<std::array<Figure12Curve, 4>> curves;  ///< by hand, then method
  int models = 0;
  double prepare_seconds = 0.0;                 ///< a model, mean
  std::map<std::string, std::string> left_out;  ///< models and why
  double wall_seconds = 0.0;                    ///< of this call
  int resumed = 0;                              ///< models that were done before
  int neighbors = 0, candidates = 0;
  std::uint64_t seed = 0;
  bool stopped_early = false;
};

/// Section VI-B of the paper: leaves out each model of the store at scale 1 and grasps it by the stored
/// grasps of the others (transfer, PCA alignment), neighbours of its class, by descriptor, and random ones;
/// beside it what the planner found on the model itself, as it stands in the store. Models whose units at
/// scale 1 have not ended with all of the hands are left out. Cost, all pre-grasps of a store with 25 a unit:
/// 7 s of a core a model for both hands.
/// @throws Error where the options are not sound, or no model is left
Figure12 run_figure12(GraspStore& store, const Figure12Options& options);

/// Means over models.
Figure12 summarise_figure12(const std::vector<Figure12Model>& models, const std::vector<std::string>& hands);

std::string figure12_markdown(const Figure12& result, const ExperimentRecord& record);
std::string figure12_json(const Figure12& result, const ExperimentRecord& record);
/// The chart of a hand: SVG text, and as a picture.
std::string figure12_svg(const Figure12& result, std::size_t hand);
Image figure12_picture(const Figure12& result, std::size_t hand);

}  // namespace eigengrasp
