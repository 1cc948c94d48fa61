// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// A direction of posture space together with the range of its amplitude.
struct Eigengrasp {
  std::string name;
  VecX direction;     ///< (n_dof)
  double min = -4.0;  ///< of the amplitude, for the direction at length 1
  double max = 4.0;
};

/// Affine subspace of hand postures, eq. (2) of the paper: p = p_m + sum_i a_i e_i, the e_i orthonormal.
class EigengraspSpace {
 public:
  /// An empty space of dimension 0 over no degrees of freedom.
  EigengraspSpace() = default;

  /// Directions are made orthonormal in their order (modified Gram-Schmidt).
  /// @throws Error where a direction has another length than the origin, is zero or depends on earlier ones.
  EigengraspSpace(VecX origin, std::vector<Eigengrasp> eigengrasps);

  /// The space that spans all postures: a_i is the i-th degree of freedom minus origin, range from the
  /// limits.
  static EigengraspSpace identity(const VecX& origin, const VecX& dof_min, const VecX& dof_max,
                                  const std::vector<std::string>& dof_names);

  /// The first n eigengrasps; where n is larger than size(), completed by directions orthogonal to them (the
  /// unit directions of the degrees of freedom, made orthonormal), with ranges that reach the limits.
  /// @pre 0 <= n <= n_dof
  EigengraspSpace with_size(int n, const VecX& dof_min, const VecX& dof_max) const;

  int size() const { return static_cast<int>(eigengrasps_.size()); }
  int n_dof() const { return static_cast<int>(origin_.size()); }
  const VecX& origin() const { return origin_; }
  const Eigengrasp& operator[](int i) const { return eigengrasps_[static_cast<std::size_t>(i)]; }
  /// (n_dof x size), orthonormal columns.
  const Eigen::MatrixXd& basis() const { return basis_; }

  /// Posture (n_dof) of amplitudes (size), eq. (2); joint limits are not applied.
  VecX embed(const VecX& amplitudes) const { return origin_ + basis_ * amplitudes; }
  /// Amplitudes of the posture's orthogonal projection onto the subspace; project(embed(a)) = a.
  VecX project(const VecX& posture) const { return basis_.transpose() * (posture - origin_); }

 private:
  VecX origin_;
  std::vector<Eigengrasp> eigengrasps_;
  Eigen::MatrixXd basis_;
};

/// Principal components of recorded postures.
struct PostureComponents {
  VecX mean;                   ///< (n_dof)
  Eigen::MatrixXd directions;  ///< (n_dof x n_dof), columns by falling variance
  VecX variance;               ///< (n_dof) [rad^2]
  /// Share of the variance that the first n components explain.
  double explained(int n) const;
};

/// @param postures (n_samples x n_dof), one recorded posture a row. @throws Error for fewer than 2 rows or
/// non-finite values.
PostureComponents compute_posture_components(const Eigen::MatrixXd& postures);

}  // namespace eigengrasp
