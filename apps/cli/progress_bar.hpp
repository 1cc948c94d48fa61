// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

namespace eigengrasp::cli {

/// A line on stderr that is drawn over; nothing where stderr is not a terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param share done, in [0, 1]
  void show(double share, const std::string& text);

 private:
  bool on_terminal_;
  bool drawn_ = false;
};

}  // namespace eigengrasp::cli
