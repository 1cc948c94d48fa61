// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>

#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "model_io/xml_file.hpp"

namespace eigengrasp {

/// The <transform> of GraspIt!: its <translation> (mm), <rotation> ("degrees axis"), <rotationMatrix> (by
/// columns) and <fullTransform> ("(w x y z)[x y z]") multiplied in their order [m].
Pose read_graspit_transform(const XmlElement& transform);

/// `d2*0.33+40`: which degree of freedom, ratio and offset in the file's unit.
struct GraspitCoupling {
  int dof = -1;
  double ratio = 1.0;
  double offset = 0.0;
};

/// Whether the text names a degree of freedom, as in d2 or d2+40, rather than a number.
bool is_graspit_coupling(const std::string& text);

/// Reads dN, dN*ratio, dN+offset or dN*ratio+offset of an element. @throws Error for anything else.
GraspitCoupling read_graspit_coupling(const XmlElement& element);

/// What a body file of GraspIt! says.
struct GraspitBody {
  TriangleMesh mesh;  ///< in the body's frame [m]; empty where meshes are not wanted
  std::string material;
  std::optional<double> youngs_modulus;  ///< [Pa]
  std::optional<Vec3> center_of_mass;    ///< [m]
  double mass = 0.0;                     ///< [kg]; 0 where unknown
};

/// Reads a body file; unit is the length of the file's unit [m].
GraspitBody read_graspit_body(const std::filesystem::path& file, double unit, bool with_mesh);

}  // namespace eigengrasp
