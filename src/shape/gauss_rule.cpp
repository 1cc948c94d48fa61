// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace eigengrasp {

// Eigenvalues and first components of the eigenvectors of the Jacobi matrix (Golub and Welsch 1969).
std::vector<GaussNode> gauss_rule(int count, int alpha) {
  Eigen::VectorXd diagonal(count), off(count - 1);
  for (int k = 0; k < count; ++k) {
    const double s = 2.0 * k + alpha;
    diagonal[k] = alpha == 0 ? 0.0 : -1.0 / (s * (s + 2.0));
    if (k > 0) off[k - 1] = alpha == 0 ? k / std::sqrt(4.0 * k * k - 1.0) : std::sqrt(k * (k + 1.0)) / s;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, off);
  std::vector<GaussNode> rule;
  for (int i = 0; i < count; ++i) {
    const double first = solver.eigenvectors()(0, i);
    rule.push_back({0.5 * (1.0 + solver.eigenvalues()[i]), first * first});
  }
  return rule;
}

}  // namespace eigengrasp
