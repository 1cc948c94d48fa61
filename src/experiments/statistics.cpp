// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace eigengrasp {

double mean(const std::vector<double>& numbers) {
  if (numbers.empty()) return 0.0;
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

double standard_deviation(const std::vector<double>& numbers) {
  if (numbers.size() < 2) return 0.0;
  const double center = mean(numbers);
  double sum = 0.0;
  for (const double x : numbers) sum += (x - center) * (x - center);
  return std::sqrt(sum / static_cast<double>(numbers.size() - 1));
}

double median(std::vector<double> numbers) {
  if (numbers.empty()) return 0.0;
  const std::size_t half = numbers.size() / 2;
  std::sort(numbers.begin(), numbers.end());
  return numbers.size() % 2 == 1 ? numbers[half] : 0.5 * (numbers[half - 1] + numbers[half]);
}

double percentile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return 0.0;
  std::sort(numbers.begin(), numbers.end());
  const double place = std::ceil(share * static_cast<double>(numbers.size()));
  return numbers[static_cast<std::size_t>(std::max(place, 1.0)) - 1];
}

}  // namespace eigengrasp
