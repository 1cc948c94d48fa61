// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/result_picture.hpp"
#include "eigengrasp/experiments/table2.hpp"

namespace eigengrasp {

/// The table as a page: for each search and friction the counts of all cells (mean and standard deviation)
/// beside the paper's and GraspIt!'s, the targets, the time of a run, how it was made, the pictures.
std::string table2_markdown(const Table2& table, const ExperimentRecord& record,
                            const std::vector<ResultPicture>& pictures = {});

/// All counts and times of all runs, the reference figures and targets.
std::string table2_json(const Table2& table, const ExperimentRecord& record);

/// Fig. 2 of the paper: the best state of the paper's search at several iterations, human hand on the glass
/// (or the nearest that was run). Figs. 3 and 4: for each hand the pre-grasp and the grasp with the largest
/// epsilon of our search with seed 1 and mu = 1 on each object. Cells without a grasp stay blank.
/// Cost: about 10 s. @param threads 0: all
std::vector<ResultPicture> table2_pictures(const Table2& table, int threads);

}  // namespace eigengrasp
