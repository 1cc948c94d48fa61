// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/cone_operator.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

#include "shape/gauss_rule.hpp"

namespace eigengrasp {

namespace {

/// R_nl(r) for n = l, l + 2, ... up to the order, with integral over r in [0, 1] of R^2 r^2 equal to 1.
Eigen::VectorXd radial_values(int order, int l, double r) {
  const int count = (order - l) / 2 + 1;
  const double beta = l + 0.5, x = 2.0 * r * r - 1.0;
  Eigen::VectorXd p(count);
  p[0] = 1.0;
  if (count > 1) p[1] = 0.5 * ((beta + 2.0) * x - beta);
  for (int k = 2; k < count; ++k) {  // Jacobi polynomials P_k^(0,beta), Abramowitz and Stegun 22.7.1
    const double c = 2.0 * k + beta;
    p[k] = ((c - 1.0) * (c * (c - 2.0) * x - beta * beta) * p[k - 1] -
            2.0 * (k - 1.0) * (k + beta - 1.0) * c * p[k - 2]) /
           (2.0 * k * (k + beta) * (c - 2.0));
  }
  const double power = std::pow(r, l);
  for (int k = 0; k < count; ++k) p[k] *= power * std::sqrt(2.0 * (l + 2 * k) + 3.0);
  return p;
}

/// Row n, column k: the part of Z_klm in C Z_nlm. Gauss's rule is exact here.
Eigen::MatrixXd cone_matrix(int order, int l) {
  const auto rule = gauss_rule(order + 2, 0);
  const int count = (order - l) / 2 + 1;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (const GaussNode& outer : rule) {
    Eigen::VectorXd cone = Eigen::VectorXd::Zero(count);
    for (const GaussNode& t : rule) cone += t.weight * t.x * t.x * radial_values(order, l, t.x * outer.x);
    matrix += (outer.weight * outer.x * outer.x) * cone * radial_values(order, l, outer.x).transpose();
  }
  return matrix.triangularView<Eigen::Lower>();
}

/// One matrix for each l; made when an order is first asked for.
const std::vector<Eigen::MatrixXd>& cone_matrices(int order) {
  static std::array<std::once_flag, kMaxZernikeOrder + 1> made;
  static std::array<std::vector<Eigen::MatrixXd>, kMaxZernikeOrder + 1> all;
  const auto place = static_cast<std::size_t>(order);
  std::call_once(made[place], [&] {
    for (int l = 0; l <= order; ++l) all[place].push_back(cone_matrix(order, l));
  });
  return all[place];
}

}  // namespace

ZernikeMoments apply_cone_operator(const ZernikeMoments& sums) {
  const int order = sums.order();
  const auto& matrices = cone_matrices(order);
  ZernikeMoments result(order);
  for (int l = 0; l <= order; ++l) {
    const Eigen::MatrixXd& matrix = matrices[static_cast<std::size_t>(l)];
    for (int n = l; n <= order; n += 2)
      for (int k = l; k <= n; k += 2)
        for (int m = -l; m <= l; ++m) result(n, l, m) += matrix((n - l) / 2, (k - l) / 2) * sums(k, l, m);
  }
  return result;
}

}  // namespace eigengrasp
