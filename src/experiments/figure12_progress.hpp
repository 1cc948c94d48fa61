// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "eigengrasp/experiments/figure12.hpp"

namespace eigengrasp {

/// Models that are done, a line of JSON each, behind a line that tells the options and the version. A file of
/// other options is begun anew; a last line that was cut does not count.
class Figure12Progress {
 public:
  explicit Figure12Progress(const Figure12Options& options);

  std::optional<Figure12Model> find(const std::string& model) const;
  void add(const Figure12Model& model);

 private:
  std::ofstream file_;
  std::map<std::string, Figure12Model> done_;
};

}  // namespace eigengrasp
