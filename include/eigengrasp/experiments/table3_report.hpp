// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/result_picture.hpp"
#include "eigengrasp/jobs/database_statistics.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Table III of the paper beside what a store holds.
struct Table3 {
  StoreStatistics statistics;
  std::int64_t objects_at_scales = 0;
};
Table3 make_table3(GraspStore& store);

/// Form-closed grasps of the paper's Table III with a hand; 0 for hands that it does not have.
std::int64_t paper_grasps(const std::string& hand);
/// Units of the paper's database with each hand: 1,814 models at four scales.
inline constexpr std::int64_t kPaperUnits = 7256;

/// Grasps of good and of low quality for each given hand: of objects all over the store the best grasp, and
/// the six grasps of the lowest epsilon, of different objects. Objects whose geometry is missing are left
/// out.
/// @param threads 0: all. Cost: all grasps are read; 10 s for 250,000
std::vector<ResultPicture> table3_pictures(GraspStore& store,
                                           const std::vector<std::shared_ptr<const HandModel>>& hands,
                                           int threads);

/// The page: grasps beside the paper's, units without grasps and why, time, epsilon, pictures.
std::string table3_markdown(const Table3& table, const ExperimentRecord& record,
                            const std::vector<ResultPicture>& pictures = {});
std::string table3_json(const Table3& table, const ExperimentRecord& record);

}  // namespace eigengrasp
