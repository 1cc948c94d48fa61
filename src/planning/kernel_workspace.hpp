// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>

#include "planning/kernel/program.hpp"

namespace eigengrasp {

/// Rows of sixteen floats, zero, aligned to cache lines.
class LaneRows {
 public:
  explicit LaneRows(int n_rows);
  /// The next n of them. @pre there are that many left
  float* take(int n);

 private:
  struct Release {
    void operator()(float* memory) const;
  };
  std::unique_ptr<float[], Release> memory_;
  float* next_;
};

/// A kernel::Workspace with its memory; all thresholds infinite. One a thread.
class KernelWorkspace {
 public:
  explicit KernelWorkspace(const kernel::Program& program);
  const kernel::Workspace& work() const { return work_; }
  /// From now on the kernel writes them.
  void keep_approaches();

 private:
  LaneRows rows_;
  float* approaches_;  ///< rows for them, whether kept or not
  kernel::Workspace work_{};
};

/// A kernel::Chains with its memory.
class KernelChains {
 public:
  explicit KernelChains(int n_amplitudes);
  const kernel::Chains& chains() const { return chains_; }

 private:
  LaneRows rows_;
  kernel::Chains chains_{};
};

}  // namespace eigengrasp
