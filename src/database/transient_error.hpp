// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

/// A call that may go well when it is made again: the server went away, or chose the transaction as the
/// victim of a deadlock.
class TransientError : public Error {
 public:
  TransientError(const std::string& sentence, bool may_be_stored)
      : Error(sentence), may_be_stored_(may_be_stored) {}
  /// The connection was lost on the commit, so that nobody knows whether it came about. Otherwise nothing of
  /// the call is stored.
  bool may_be_stored() const { return may_be_stored_; }

 private:
  bool may_be_stored_;
};

}  // namespace eigengrasp
