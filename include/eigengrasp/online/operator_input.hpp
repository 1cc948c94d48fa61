// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// One reading of a tracker: where the operator holds the wrist.
struct WristSample {
  double time = 0.0;             ///< of the sender's clock [s]; only differences and order count
  Pose X_OH = Pose::Identity();  ///< hand base in the object frame
};

/// Shared control: a value that the operator wants for a variable of the search, as decoded from cortical or
/// muscle activity, or from a glove that knows only some joints.
struct VariableTarget {
  enum class Variable {
    distance,   ///< along the approach direction [m]
    theta,      ///< cone angle [rad], about the axis that phi names
    phi,        ///< [rad], of the plane in which the approach direction leans
    amplitude,  ///< of the eigengrasp `index`
    dof,        ///< degree of freedom `index` of the hand [rad or m]
  };
  Variable variable = Variable::amplitude;
  int index = 0;
  double value = 0.0;
  /// 0: says nothing; 1: certain, the search keeps to the value. In between the variable is drawn towards it.
  double confidence = 1.0;
};

/// What the operator does.
enum class OperatorCommand {
  close,   ///< the click: close all fingers where the hand is
  open,    ///< let go, go on with the approach
  forget,  ///< drop the solutions found so far
};

/// Takes the newest of a stream of wrist poses that come at any rate, late, twice or out of order.
class WristTrack {
 public:
  enum class Taken {
    newest,     ///< is the newest now
    late,       ///< older than the newest: dropped
    duplicate,  ///< same time as the newest: dropped
    invalid,    ///< not finite, or no rigid motion: dropped
    restarted,  ///< the sender's clock went back by more than `clock_reset`: taken as a new stream
  };
  static constexpr double clock_reset = 1.0;  ///< [s]

  Taken take(const WristSample& sample);
  const std::optional<WristSample>& newest() const { return newest_; }

  struct Counts {
    long taken = 0, late = 0, duplicate = 0, invalid = 0, restarted = 0;
  };
  const Counts& counts() const { return counts_; }

 private:
  std::optional<WristSample> newest_;
  Counts counts_;
};

}  // namespace eigengrasp
