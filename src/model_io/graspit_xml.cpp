// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/graspit_xml.hpp"

#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// "(w x y z)[x y z]", the position in mm.
Pose read_full_transform(const XmlElement& element) {
  std::string text = element.text();
  const auto open = text.find('('), close = text.find(')'), bracket = text.find('['), end = text.find(']');
  if (open == 0 && close != std::string::npos && bracket != std::string::npos && end == text.size() - 1 &&
      close < bracket && trimmed(text.substr(close + 1, bracket - close - 1)).empty()) {
    const auto q = parse_numbers(text.substr(1, close - 1));
    const auto p = parse_numbers(text.substr(bracket + 1, end - bracket - 1));
    if (q && p && q->size() == 4 && p->size() == 3) {
      const Eigen::Quaterniond rotation((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
      if (rotation.norm() < 1e-6) {
        element.fail("<{}> is \"{}\", expected a quaternion that is not zero", element.name(), shown(text));
      }
      return make_pose(rotation, metres_of_mm * Vec3((*p)[0], (*p)[1], (*p)[2]));
    }
  }
  element.fail("<{}> is \"{}\", expected \"(w x y z)[x y z]\"", element.name(), shown(text));
}

Pose read_rotation(const XmlElement& element) {
  const std::string text = element.text();
  const std::string_view all = text;
  const char axis = all.empty() ? ' ' : all.back();
  const auto degrees = parse_number(all.substr(0, all.empty() ? 0 : all.size() - 1));
  if (!degrees || axis < 'x' || axis > 'z') {
    element.fail("<rotation> is \"{}\", expected degrees and an axis such as \"90 x\"", shown(text));
  }
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(*degrees * radians_of_degree, Vec3::Unit(axis - 'x')).toRotationMatrix();
  return X;
}

Pose read_rotation_matrix(const XmlElement& element) {
  const auto v = element.numbers(9);
  Mat3 R;
  R << v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8];  // by columns
  if ((R * R.transpose() - Mat3::Identity()).norm() > 0.02 || R.determinant() < 0.0) {
    element.fail("<rotationMatrix> is \"{}\", expected the 9 numbers of a rotation by columns",
                 shown(element.text()));
  }
  // Written with a few digits: through a quaternion it becomes a rotation again.
  return make_pose(Eigen::Quaterniond(R), Vec3::Zero());
}

std::optional<GraspitCoupling> parse_coupling(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2 || text[0] != 'd') return std::nullopt;
  GraspitCoupling coupling;
  const auto plus = text.find('+');
  if (plus != std::string_view::npos) {
    const auto offset = parse_number(text.substr(plus + 1));
    if (!offset) return std::nullopt;
    coupling.offset = *offset;
    text = text.substr(0, plus);
  }
  const auto times = text.find('*');
  if (times != std::string_view::npos) {
    const auto ratio = parse_number(text.substr(times + 1));
    if (!ratio) return std::nullopt;
    coupling.ratio = *ratio;
    text = text.substr(0, times);
  }
  const auto dof = parse_integer(text.substr(1));
  if (!dof || *dof < 0) return std::nullopt;
  coupling.dof = *dof;
  return coupling;
}

}  // namespace

Pose read_graspit_transform(const XmlElement& transform) {
  Pose X = Pose::Identity();
  for (const XmlElement& part : transform.children()) {
    if (part.name() == "translation") {
      X = X * Eigen::Translation3d(metres_of_mm * part.vector());
    } else if (part.name() == "rotation") {
      X = X * read_rotation(part);
    } else if (part.name() == "rotationMatrix") {
      X = X * read_rotation_matrix(part);
    } else if (part.name() == "fullTransform") {
      X = X * read_full_transform(part);
    } else {
      part.fail("<{}> in a <transform>, expected one of translation, rotation, rotationMatrix, fullTransform",
                part.name());
    }
  }
  return X;
}

bool is_graspit_coupling(const std::string& text) {
  return !text.empty() && text[0] == 'd';
}

GraspitCoupling read_graspit_coupling(const XmlElement& element) {
  const auto coupling = parse_coupling(element.text());
  if (!coupling) {
    element.fail(
        "<{}> is \"{}\", expected dN, dN*ratio, dN+offset or dN*ratio+offset (a negative offset is "
        "written +-5)",
        element.name(), shown(element.text()));
  }
  if (coupling->ratio == 0.0) {
    element.fail("<{}> is \"{}\", expected a ratio that is not 0", element.name(), shown(element.text()));
  }
  return *coupling;
}

}  // namespace eigengrasp
