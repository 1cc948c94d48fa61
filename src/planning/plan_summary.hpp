// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// Such as "annealing/contact" (--search paper) or "staged/contact".
std::string planner_name(const PlanOptions& options);

/// 16 hexadecimal digits of all options that change the result.
std::string options_digest(const PlanOptions& options);

/// Sets the status and the sentence that says what was found, or why nothing was.
void explain(const Scene& scene, const PlanOptions& options, PlanResult& result);

}  // namespace eigengrasp
