// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

namespace eigengrasp {

// All are 0 of no numbers.

double mean(const std::vector<double>& numbers);
/// Of a sample (divided by n - 1); 0 of a single number.
double standard_deviation(const std::vector<double>& numbers);
/// Of an even count, the mean of the two in the middle.
double median(std::vector<double> numbers);
/// The smallest number that at least this share of all does not exceed. @param share in (0, 1]
double percentile(std::vector<double> numbers, double share);

}  // namespace eigengrasp
