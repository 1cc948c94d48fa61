// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <string_view>

#include "eigengrasp/database/store_records.hpp"

namespace eigengrasp {

/// A grasp as bytes, bit by bit, but for its hand, object and scale, which its row says. Little-endian; the
/// layout is in docs/grasp-store.md. Names of the hand's joints and links take two bytes.
std::string encode_grasp(const Grasp& grasp, const StoredHand& hand);

/// @param where what errors call the grasp
/// @throws Error where the bytes are not what encode_grasp writes
Grasp decode_grasp(std::string_view bytes, const StoredHand& hand, const std::string& where);

}  // namespace eigengrasp
