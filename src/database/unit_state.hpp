// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <string_view>

#include "eigengrasp/database/store_records.hpp"

namespace eigengrasp {

/// The inverse of to_string. @throws Error for another word
UnitState parse_unit_state(std::string_view word, const std::string& where);

}  // namespace eigengrasp
