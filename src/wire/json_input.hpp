// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <nlohmann/json.hpp>

#include "eigengrasp/wire/wire_text.hpp"

namespace eigengrasp::wire {

/// A text as JSON that is sound by an entry of the schema.
/// @throws Error, one sentence, for a text beyond the limits, that is not JSON, or not in the schema.
nlohmann::json checked_json(std::string_view text, std::string_view definition, const TextLimits& limits);

}  // namespace eigengrasp::wire
