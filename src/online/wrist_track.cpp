// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cmath>

#include "eigengrasp/online/operator_input.hpp"

namespace eigengrasp {

namespace {

constexpr double largest_position = 1e3;  // [m]: beyond it a reading cannot be meant
constexpr double rotation_error = 1e-3;

bool is_rigid_motion(const Pose& X) {
  const Mat3 R = X.linear();
  return X.matrix().allFinite() && X.translation().norm() < largest_position &&
         (R.transpose() * R - Mat3::Identity()).norm() < rotation_error && R.determinant() > 0.0;
}

}  // namespace

WristTrack::Taken WristTrack::take(const WristSample& sample) {
  if (!std::isfinite(sample.time) || !is_rigid_motion(sample.X_OH)) {
    ++counts_.invalid;
    return Taken::invalid;
  }
  Taken taken = Taken::newest;
  if (newest_ && sample.time <= newest_->time) {
    if (sample.time == newest_->time) {
      ++counts_.duplicate;
      return Taken::duplicate;
    }
    if (sample.time > newest_->time - clock_reset) {
      ++counts_.late;
      return Taken::late;
    }
    ++counts_.restarted;
    taken = Taken::restarted;
  }
  ++counts_.taken;
  newest_ = sample;
  return taken;
}

}  // namespace eigengrasp
