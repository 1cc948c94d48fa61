// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/kinematics/eigengrasp_space.hpp"

#include <Eigen/Eigenvalues>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace {

/// A direction counts as dependent on others where less than this share of its length is left.
constexpr double min_independent_share = 1e-6;

/// What is left of v without its parts along the first n columns; done twice, so that rounding does not
/// leave any of them in it.
VecX remove_parts(const Eigen::MatrixXd& basis, int n, VecX v) {
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i < n; ++i) v -= basis.col(i).dot(v) * basis.col(i);
  return v;
}

std::string label(int i, const std::string& name) {
  return name.empty() ? fmt::format("eigengrasp {}", i + 1)
                      : fmt::format("eigengrasp {} (\"{}\")", i + 1, name);
}

}  // namespace

EigengraspSpace::EigengraspSpace(VecX origin, std::vector<Eigengrasp> eigengrasps)
    : origin_(std::move(origin)), eigengrasps_(std::move(eigengrasps)) {
  if (!origin_.allFinite()) fail("the origin of the eigengrasps holds a value that is not a number");
  basis_.resize(origin_.size(), size());
  for (int i = 0; i < size(); ++i) {
    Eigengrasp& e = eigengrasps_[static_cast<std::size_t>(i)];
    if (e.direction.size() != origin_.size()) {
      fail("{}: the direction has {} values, expected {}, one a degree of freedom", label(i, e.name),
           e.direction.size(), origin_.size());
    }
    const double length = e.direction.norm();
    if (!std::isfinite(length))
      fail("{}: the direction holds a value that is not a number", label(i, e.name));
    if (length == 0.0)
      fail("{}: the direction is zero, expected a direction with a length", label(i, e.name));
    const VecX rest = remove_parts(basis_, i, e.direction / length);
    if (rest.norm() < min_independent_share) {
      fail("{}: the direction is a combination of the earlier ones; leave it out", label(i, e.name));
    }
    e.direction = rest.normalized();
    basis_.col(i) = e.direction;
  }
}

EigengraspSpace EigengraspSpace::identity(const VecX& origin, const VecX& dof_min, const VecX& dof_max,
                                          const std::vector<std::string>& dof_names) {
  std::vector<Eigengrasp> unit;
  for (Eigen::Index d = 0; d < origin.size(); ++d) {
    unit.push_back({dof_names[static_cast<std::size_t>(d)], VecX::Unit(origin.size(), d),
                    dof_min[d] - origin[d], dof_max[d] - origin[d]});
  }
  return EigengraspSpace(origin, std::move(unit));
}

EigengraspSpace EigengraspSpace::with_size(int n, const VecX& dof_min, const VecX& dof_max) const {
  std::vector<Eigengrasp> chosen(eigengrasps_.begin(), eigengrasps_.begin() + std::min(n, size()));
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n_dof(), n);
  basis.leftCols(std::min(n, size())) = basis_.leftCols(std::min(n, size()));
  for (int i = size(); i < n; ++i) {
    // The degree of freedom that the chosen directions explain least: the best conditioned, first of equals.
    Eigen::Index d = 0;
    (1.0 - basis.leftCols(i).rowwise().squaredNorm().array()).maxCoeff(&d);
    const VecX e = remove_parts(basis, i, VecX::Unit(n_dof(), d)).normalized();
    basis.col(i) = e;
    // The shadow of the box of all postures on e.
    const Eigen::ArrayXd to_min = e.array() * (dof_min - origin_).array();
    const Eigen::ArrayXd to_max = e.array() * (dof_max - origin_).array();
    chosen.push_back({fmt::format("complement {}", i + 1 - size()), e, to_min.min(to_max).sum(),
                      to_min.max(to_max).sum()});
  }
  return EigengraspSpace(origin_, std::move(chosen));
}

double PostureComponents::explained(int n) const {
  const double total = variance.sum();
  return total > 0.0 ? variance.head(n).sum() / total : 1.0;
}

PostureComponents compute_posture_components(const Eigen::MatrixXd& postures) {
  if (postures.rows() < 2) {
    fail("principal components need at least 2 recorded postures, found {}", postures.rows());
  }
  for (Eigen::Index row = 0; row < postures.rows(); ++row) {
    if (!postures.row(row).allFinite()) {
      fail("recorded posture {} holds a value that is not a number", row + 1);
    }
  }
  PostureComponents result;
  result.mean = postures.colwise().mean().transpose();
  const Eigen::MatrixXd centred = postures.rowwise() - result.mean.transpose();
  const Eigen::MatrixXd covariance = centred.transpose() * centred / static_cast<double>(postures.rows() - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  result.variance = solver.eigenvalues().reverse().cwiseMax(0.0);
  result.directions = solver.eigenvectors().rowwise().reverse();
  for (auto e : result.directions.colwise()) {  // the sign is free: largest entry positive
    Eigen::Index largest = 0;
    e.cwiseAbs().maxCoeff(&largest);
    if (e[largest] < 0.0) e = -e.eval();
  }
  return result;
}

}  // namespace eigengrasp
