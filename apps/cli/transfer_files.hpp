// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/render/image.hpp"
#include "eigengrasp/transfer/grasp_transfer.hpp"

namespace eigengrasp::cli {

/// transfer.json: the neighbours, and of each grasp the stored one that it comes from.
std::string transfer_json(const TransferResult& result, const std::string& store);

/// As Fig. 11 of the paper: above a neighbour with a stored grasp, below it the object with the grasp that
/// came of it, both seen alike; the best grasps first. Neighbours whose geometry cannot be read are left out.
/// @param from_hand of the stored grasps @param most grasps, >= 1 @pre there are grasps
Image transfer_picture(const Scene& scene, const TransferStore& store, const TransferResult& result,
                       const std::shared_ptr<const HandModel>& from_hand, std::size_t most, int threads);

}  // namespace eigengrasp::cli
