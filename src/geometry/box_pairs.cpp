// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "geometry/box_pairs.hpp"

#include <algorithm>

#include "core/variants.hpp"

namespace eigengrasp::detail {

namespace {

box_kernel::Joint joint_of(const Screw& s) {
  box_kernel::Joint joint{};
  const double spin = s.angular.norm();
  for (int k = 0; k < 3; ++k) {
    joint.angular[k] = static_cast<float>(s.angular[k]);
    joint.linear[k] = static_cast<float>(s.linear[k]);
    joint.axis[k] = spin > 0.0 ? static_cast<float>(s.angular[k] / spin) : 0.0f;
  }
  joint.spin = static_cast<float>(spin);
  return joint;
}

double reach(const MeshBvh& bvh) {
  return bvh.box().min.cwiseAbs().cwiseMax(bvh.box().max.cwiseAbs()).norm();
}

}  // namespace

BoxPairs::BoxPairs(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB)
    : b_(b), X_AB_(X_AB), functions_(EIGENGRASP_VARIANT(box_kernel, best_instruction_set())) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) place_.rotation[r][c] = static_cast<float>(X_AB.linear()(r, c));
    place_.origin[r] = static_cast<float>(X_AB.translation()[r]);
  }
  static_assert(sizeof(MeshBvh::OrientedBox) == box_kernel::box_stride * sizeof(float));
  pairs_.boxes_a = &a.oriented_box(0).rows[0][0];
  pairs_.boxes_b = &b.oriented_box(0).rows[0][0];
  place_.rounding = static_cast<float>(4e-6 * (reach(a) + reach(b) + X_AB.translation().norm()));
}

void BoxPairs::set_motion(const SurfaceMotion& motion, double margin) {
  const std::size_t n = motion.of_a.size() + motion.of_b.size();
  box_kernel::Joint* joints = few_joints_;
  if (n > few) {
    many_joints_.resize(n);
    joints = many_joints_.data();
  }
  std::transform(motion.of_b.begin(), motion.of_b.end(),
                 std::transform(motion.of_a.begin(), motion.of_a.end(), joints, joint_of), joint_of);
  motion_.joints = joints;
  motion_.n_of_a = static_cast<int>(motion.of_a.size());
  motion_.n = static_cast<int>(n);
  motion_.margin = static_cast<float>(margin);
  motion_.acceleration = static_cast<float>(1.000001 * motion.acceleration);
}

void BoxPairs::look_at_times(double outlook) {
  constexpr double longest = 1000.0;  // [s] of any use
  motion_.outlook = static_cast<float>(std::min(outlook, longest));
  functions_.times(place_, motion_, pairs_);
}

}  // namespace eigengrasp::detail
