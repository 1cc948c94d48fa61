// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/transfer/grasp_transfer.hpp"

namespace eigengrasp {

/// Such as "transfer/zernike/pca", or with another hand's grasps "transfer/zernike/pca/human".
/// @pre distance and alignment are chosen
std::string transfer_planner_name(const TransferOptions& options);

/// Sets the sentence that says what was found, or why nothing was.
void explain_transfer(const ObjectModel& object, const TransferOptions& options, TransferResult& result);

}  // namespace eigengrasp
