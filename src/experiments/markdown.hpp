// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

namespace eigengrasp {

/// A table; every row has as many cells as there are headings. Ends with a newline.
std::string markdown_table(const std::vector<std::string>& headings,
                           const std::vector<std::vector<std::string>>& rows);

}  // namespace eigengrasp
