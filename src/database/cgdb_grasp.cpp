// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/cgdb_grasp.hpp"

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace {

constexpr double kMillimetre = 1e-3;  // [m]
constexpr double kJointsAreDofs = 5.0;
constexpr double kPositionIsComplete = 0.0;

std::vector<double> joints_of(const VecX& dofs) {
  std::vector<double> out = {kJointsAreDofs};
  out.insert(out.end(), dofs.begin(), dofs.end());
  return out;
}

std::vector<double> position_of(const Pose& X_OH) {
  const Vec3 p = X_OH.translation() / kMillimetre;
  const Eigen::Quaterniond q = orientation(X_OH);
  return {kPositionIsComplete, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

VecX dofs_of(const std::vector<double>& joints, const std::string& where) {
  if (joints.empty() || joints[0] != kJointsAreDofs)
    fail("{}: the joints do not begin with {}, expected the hand's degrees of freedom", where,
         kJointsAreDofs);
  return Eigen::Map<const VecX>(joints.data() + 1, static_cast<Eigen::Index>(joints.size()) - 1);
}

Pose pose_of(const std::vector<double>& v, const std::string& where) {
  if (v.size() != 8 || v[0] != kPositionIsComplete)
    fail("{}: a position has {} numbers, expected 0, x, y, z, and a quaternion w, x, y, z", where, v.size());
  const Eigen::Quaterniond q(v[4], v[5], v[6], v[7]);
  if (!(q.norm() > 1e-9)) fail("{}: the quaternion of a position is zero", where);
  return make_pose(q, kMillimetre * Vec3(v[1], v[2], v[3]));
}

}  // namespace

CgdbGrasp to_cgdb(const Grasp& g) {
  CgdbGrasp row{joints_of(g.pregrasp_dofs),
                position_of(g.X_OH_pregrasp),
                joints_of(g.grasp_dofs),
                position_of(g.X_OH),
                {}};
  row.contacts.reserve(3 * g.contacts.size());
  for (const GraspContact& c : g.contacts)
    for (const double x : c.point.p_OC) row.contacts.push_back(x / kMillimetre);
  return row;
}

Grasp from_cgdb(const CgdbGrasp& row, const std::string& where) {
  Grasp g;
  g.pregrasp_dofs = dofs_of(row.pregrasp_joints, where);
  g.X_OH_pregrasp = pose_of(row.pregrasp_position, where);
  g.grasp_dofs = dofs_of(row.grasp_joints, where);
  g.X_OH = pose_of(row.grasp_position, where);
  if (row.contacts.size() % 3 != 0)
    fail("{}: the contacts have {} numbers, expected three each", where, row.contacts.size());
  for (std::size_t i = 0; i < row.contacts.size(); i += 3) {
    GraspContact c;
    c.point.p_OC = kMillimetre * Vec3(row.contacts[i], row.contacts[i + 1], row.contacts[i + 2]);
    g.contacts.push_back(c);
  }
  return g;
}

}  // namespace eigengrasp
