// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/axis_rotations.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>

namespace eigengrasp {

namespace {

bool equal(const AlignmentShape& shape, int i, double ratio) {
  return shape.deviations[i] <= ratio * shape.deviations[i + 1];
}

/// Every proper rotation that takes axes to axes by one of these permutations.
void add_signed(const std::array<int, 3>& order, std::vector<Mat3>& turns) {
  for (int signs = 0; signs < 8; ++signs) {
    Mat3 turn = Mat3::Zero();
    for (int k = 0; k < 3; ++k) turn(order[static_cast<std::size_t>(k)], k) = (signs >> k & 1) != 0 ? -1 : 1;
    if (turn.determinant() > 0.0) turns.push_back(turn);
  }
}

/// Rotations among the axes 0, 1, 2 where the first two, or the last two, count as equal.
std::vector<Mat3> turns_of(bool first_equal, bool last_equal) {
  std::vector<Mat3> turns;
  std::array<int, 3> order{0, 1, 2};
  do {
    const bool among_first = order[2] == 2, among_last = order[0] == 0;
    if ((among_first && among_last) || (first_equal && last_equal) || (first_equal && among_first) ||
        (last_equal && among_last))
      add_signed(order, turns);
  } while (std::next_permutation(order.begin(), order.end()));
  return turns;
}

}  // namespace

std::vector<Mat3> axis_rotations(const AlignmentShape& model, const AlignmentShape& target, double equal_axes,
                                 bool eighth_turns) {
  const bool first = equal(model, 0, equal_axes) || equal(target, 0, equal_axes);
  const bool last = equal(model, 1, equal_axes) || equal(target, 1, equal_axes);
  std::vector<Mat3> turns = turns_of(first, last);
  if (eighth_turns && (first || last)) {
    const Vec3 axis = last && !first ? Vec3::UnitX() : Vec3::UnitZ();
    const Mat3 eighth = Eigen::AngleAxisd(0.25 * std::numbers::pi, axis).toRotationMatrix();
    const std::size_t count = turns.size();
    for (std::size_t i = 0; i < count; ++i) turns.push_back(eighth * turns[i]);
  }
  for (Mat3& turn : turns) turn = target.axes * turn * model.axes.transpose();
  return turns;
}

}  // namespace eigengrasp
