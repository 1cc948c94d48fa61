// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>

#include "planning/kernel/program.hpp"

namespace eigengrasp {

/// A kernel::Workspace with its memory, aligned to cache lines; all thresholds infinite. One a thread.
class KernelWorkspace {
 public:
  explicit KernelWorkspace(const kernel::Program& program);

  const kernel::Workspace& work() const { return work_; }
  /// Writes a value to a lane of a row of the workspace.
  static void put(float* row, int lane, double value) { row[lane] = static_cast<float>(value); }

 private:
  struct Release {
    void operator()(float* memory) const;
  };
  kernel::Workspace work_{};
  std::unique_ptr<float[], Release> memory_;
};

}  // namespace eigengrasp
