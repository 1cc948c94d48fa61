// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/experiments/machine.hpp"
#include "report/json_text.hpp"

namespace eigengrasp {

/// {"command": ..., "version": ..., "machine": {...}}
OrderedJson record_json(const ExperimentRecord& record);

}  // namespace eigengrasp
