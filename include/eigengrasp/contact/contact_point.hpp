// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// One point of a contact between hand and object, in the object frame O.
/// The hand presses along n_OC, into the object, with a normal force f_n >= 0. With tangential friction force
/// f_t and friction torque t_n about the normal it can transmit what satisfies
///   |f_t|^2 / mu^2 + t_n^2 / (mu e)^2 <= f_n^2,      e = torsion_length,
/// the elliptic limit surface of a soft finger (Howe and Cutkosky 1996; Ciocarlie, Lackner, Allen 2007). With
/// e = 0 it is the point contact with Coulomb friction: t_n = 0.
struct ContactPoint {
  Vec3 p_OC = Vec3::Zero();     ///< position [m]
  Vec3 n_OC = Vec3::UnitZ();    ///< unit normal, into the object
  double mu = 0.0;              ///< friction coefficient [-], >= 0
  double torsion_length = 0.0;  ///< e [m], >= 0
};

/// Two unit vectors that make a right-handed orthonormal frame (t1, t2, n) with a unit normal n: t1 along n x
/// X, or n x Z where n is as good as parallel to X. GraspIt! begins the edges of its cones there too, so that
/// polytopes of equal contacts are equal.
std::array<Vec3, 2> contact_tangents(const Vec3& n);

/// Torsion length e = 8 sqrt(a b) / 15 [m] of a soft finger on its elliptic contact patch with semi-axes a,
/// b. The patch comes from the relative principal curvatures of both surfaces (k1, k2 >= 0, [1/m]; smaller
/// than 1 / max_radius is taken as flat, with radius max_radius = 20 mm), Young's modulus [Pa], a pad
/// thickness h = 3 mm and the normal force 5 N: indentation delta = sqrt(f h / (E pi sqrt(r1 r2))), a =
/// sqrt(2 delta r1), b = sqrt(2 delta r2) (elastic foundation; Johnson 1985, ch. 4; Ciocarlie, Lackner, Allen
/// 2007).
double soft_finger_torsion_length(double k1, double k2, double youngs_modulus);

}  // namespace eigengrasp
