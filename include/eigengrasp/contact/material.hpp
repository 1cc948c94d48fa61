// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>

namespace eigengrasp {

/// What a surface is made of, as far as contacts care.
struct Material {
  std::string name;                      ///< one of the friction table's, or any name where friction is given
  std::optional<double> friction;        ///< Coulomb coefficient against anything [-]; wins over the table
  std::optional<double> youngs_modulus;  ///< [Pa]; given: contacts are soft fingers
};

/// Static friction coefficient between two named materials: GraspIt!'s table (glass, metal, wood, plastic,
/// rubber, stone, frictionless). Unknown and empty names count as wood, as GraspIt! does.
double table_friction(const std::string& a, const std::string& b);

/// Friction of a contact: the hand material's own coefficient where it has one, else the object's, else the
/// table's.
double contact_friction(const Material& hand, const Material& object);

}  // namespace eigengrasp
