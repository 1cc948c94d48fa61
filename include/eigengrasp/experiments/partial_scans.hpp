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
#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/result_picture.hpp"
#include "eigengrasp/scan/scan_surface.hpp"
#include "eigengrasp/transfer/grasp_transfer.hpp"

namespace eigengrasp {

/// How grasps on a scan are found.
enum class ScanPlanner { transfer, planner };
inline constexpr std::array<ScanPlanner, 2> kScanPlanners = {ScanPlanner::transfer, ScanPlanner::planner};

struct PartialScansOptions {
  std::filesystem::path complete;  ///< folder of complete objects, for simulated depth cameras; may be empty
  /// Folder of real ones; may be empty. OBJECT/VIEW.ply; or OBJECT/LIST.conf, of which each scan is a view
  /// and all together are one more. A mesh with faces beside them is the complete object in their frame.
  /// Where there are only meshes, they are the views.
  std::filesystem::path scans;
  GraspStore* store = nullptr;  ///< described, with grasps of the hands
  std::vector<std::shared_ptr<const HandModel>> hands;
  /// Name of a scanned object and of its complete one, where neither holds the other.
  std::map<std::string, std::string> same;
  int neighbors = 5;      ///< of the store, from which grasps are transferred; 1 to 1000
  int views = 3;          ///< simulated, of each object
  int best = 20;          ///< grasps that are tried on the complete object
  double distance = 0.7;  ///< of the simulated camera [m]
  double noise = 0.001;   ///< see DepthCamera
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all; does not change the result
  bool pictures = true;
  const StopFlag* stop = nullptr;
  std::function<void(int done, int all)> progress;
};

/// What one way of planning found with one hand on the surface made of one view.
struct ScanGrasps {
  std::string hand;
  ScanPlanner planner = ScanPlanner::transfer;
  int found = 0;              ///< distinct form-closed grasps on the surface
  double best_epsilon = 0.0;  ///< on the surface
  double seconds = 0.0;       ///< of a core, without making the surface
  int tried = 0;              ///< of the best, on the complete object
  int closed = 0;             ///< of those, still form-closed
};

/// One view of one object.
struct ScanTrial {
  std::string object, view;
  bool simulated = false;
  std::string failure;    ///< why there is no surface; empty: there is
  bool mirrored = false;  ///< a mirror plane was found
  double seen_share = 0.0;
  double agreement =
      -1.0;  ///< volume common to the surface and the complete object over that of both; -1: unknown
  double seconds = 0.0;  ///< of a core, to make the surface
  std::string complete;  ///< the complete object that the best grasps are tried on; empty: none
  double misfit = 0.0;   ///< of a real scan: root mean square distance of what was seen from it [m]
  std::vector<ScanGrasps> grasps;
};

/// A scan that fits no better is not tried on the complete object [m].
inline constexpr double kMostMisfit = 0.005;

struct PartialScans {
  std::vector<ScanTrial> trials;  ///< simulated ones first, by object and view
  std::vector<ResultPicture> pictures;
  bool stopped_early = false;
};

/// Section VI-C of the paper: grasps planned on what one view shows. Simulated views come with the complete
/// object, as may real ones; others are laid upon a complete object whose name holds theirs (one-sided
/// alignment by icp of what was seen; kMostMisfit), on which the best grasps are tried: the hand comes along
/// its approach direction until it touches, and closes (rate_pregrasps). Cost: about 4 s of a core a view and
/// hand.
/// @throws Error where a folder holds nothing to read, or the store has no grasps of a hand
PartialScans run_partial_scans(const PartialScansOptions& options);

std::string partial_scans_markdown(const PartialScans& result, const PartialScansOptions& options,
                                   const ExperimentRecord& record);
std::string partial_scans_json(const PartialScans& result, const ExperimentRecord& record);

}  // namespace eigengrasp
