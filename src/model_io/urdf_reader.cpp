// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/urdf_reader.hpp"

#include <numbers>

#include "model_io/file_bounds.hpp"
#include "model_io/text_values.hpp"
#include "model_io/xml_file.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

/// <origin xyz rpy>: roll about x, then pitch about y, then yaw about z, all about fixed axes.
Pose read_origin(const XmlElement& parent) {
  Pose X = Pose::Identity();
  const XmlElement origin = parent.child("origin");
  if (!origin) return X;
  const Vec3 rpy = origin.attribute_vector("rpy", Vec3::Zero());
  X.linear() = (Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
                Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
                   .toRotationMatrix();
  X.translation() = origin.attribute_vector("xyz", Vec3::Zero());
  return X;
}

/// package://NAME/REST in a parent folder of the URDF that is NAME or holds NAME.
fs::path find_in_package(const XmlElement& mesh, const std::string& rest, const fs::path& only_within) {
  const auto slash = rest.find('/');
  if (slash == std::string::npos || slash == 0) {
    mesh.fail("<mesh>: filename is \"package://{}\", expected package://NAME/FILE", shown(rest));
  }
  const std::string package = rest.substr(0, slash), file = rest.substr(slash + 1);
  const auto is_there = [&](const fs::path& candidate) {
    std::error_code ec;
    return is_within(candidate, only_within) && fs::is_regular_file(candidate, ec);
  };
  for (fs::path folder = fs::absolute(mesh.file()).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    if (is_there(folder / package / file)) return folder / package / file;
    if (folder.filename() == package && is_there(folder / file)) return folder / file;
    if (folder == folder.parent_path()) break;
  }
  mesh.fail(
      "<mesh>: filename is \"package://{}\", but it is in no package \"{}\" above {}; write it relative "
      "to the URDF",
      shown(rest), shown(package), mesh.file().filename().string());
}

fs::path find_mesh(const XmlElement& mesh, const fs::path& only_within) {
  const std::string name = mesh.require_attribute("filename");
  if (name.starts_with("package://")) return find_in_package(mesh, name.substr(10), only_within);
  const fs::path relative = name.starts_with("file://") ? name.substr(7) : name;
  const fs::path file = mesh.file().parent_path() / relative;
  if (!is_within(file, only_within)) {
    mesh.fail("<mesh>: filename is \"{}\", which lies outside of the hand's folder, expected a file in it",
              shown(name));
  }
  std::error_code ec;
  if (!fs::is_regular_file(file, ec)) {
    mesh.fail("<mesh>: filename is \"{}\", but {} does not exist", shown(name), file.string());
  }
  return file;
}

double require_length(const XmlElement& element, const char* attribute) {
  const double length = element.require_attribute_number(attribute);
  if (length <= 0.0) {
    element.fail("<{}>: {} is \"{}\", expected a positive length [m]", element.name(), attribute,
                 shown(element.require_attribute(attribute)));
  }
  return length;
}

UrdfShape read_shape(const XmlElement& element, const fs::path& only_within) {
  const XmlElement geometry = element.require_child("geometry");
  UrdfShape shape;
  shape.X_LS = read_origin(element);
  shape.line = geometry.line();
  if (const XmlElement mesh = geometry.child("mesh")) {
    shape.kind = UrdfShape::Kind::mesh;
    shape.file = find_mesh(mesh, only_within);
    shape.size = mesh.attribute_vector("scale", Vec3::Ones());
    if ((shape.size.array() == 0.0).any()) {
      mesh.fail("<mesh>: scale is \"{}\", expected 3 numbers that are not 0",
                mesh.require_attribute("scale"));
    }
  } else if (const XmlElement box = geometry.child("box")) {
    shape.kind = UrdfShape::Kind::box;
    shape.size = box.require_attribute_vector("size");
    if ((shape.size.array() <= 0.0).any()) {
      box.fail("<box>: size is \"{}\", expected 3 positive lengths [m]", box.require_attribute("size"));
    }
  } else if (const XmlElement cylinder = geometry.child("cylinder")) {
    shape.kind = UrdfShape::Kind::cylinder;
    shape.size = Vec3(require_length(cylinder, "radius"), require_length(cylinder, "length"), 0.0);
  } else if (const XmlElement sphere = geometry.child("sphere")) {
    shape.kind = UrdfShape::Kind::sphere;
    shape.size = Vec3(require_length(sphere, "radius"), 0.0, 0.0);
  } else {
    geometry.fail("<geometry> holds none of mesh, box, cylinder, sphere, expected one of them");
  }
  return shape;
}

UrdfLink read_link(const XmlElement& element, const fs::path& only_within) {
  UrdfLink link;
  link.name = element.require_attribute("name");
  link.line = element.line();
  const bool has_collision = static_cast<bool>(element.child("collision"));
  for (const XmlElement& shape : element.children(has_collision ? "collision" : "visual")) {
    link.shapes.push_back(read_shape(shape, only_within));
  }
  const XmlElement inertial = element.child("inertial");
  if (const XmlElement mass = inertial ? inertial.child("mass") : XmlElement()) {
    link.mass = mass.require_attribute_number("value");
    if (link.mass < 0.0) {
      mass.fail("<mass>: value is \"{}\", expected a positive number of kg", mass.require_attribute("value"));
    }
  }
  return link;
}

void read_limits(const XmlElement& element, const std::string& type, UrdfJoint& joint) {
  if (type == "continuous") {
    joint.lower = -std::numbers::pi;
    joint.upper = std::numbers::pi;
    return;
  }
  const XmlElement limit = element.require_child("limit");
  joint.lower = limit.attribute_number("lower", 0.0);
  joint.upper = limit.attribute_number("upper", 0.0);
  if (joint.lower > joint.upper) {
    limit.fail("<limit> of joint {}: lower is \"{}\", expected at most upper, {}", joint.name, joint.lower,
               joint.upper);
  }
}

std::optional<UrdfMimic> read_mimic(const XmlElement& element) {
  const XmlElement mimic = element.child("mimic");
  if (!mimic) return std::nullopt;
  UrdfMimic result;
  result.joint = mimic.require_attribute("joint");
  result.multiplier = mimic.attribute_number("multiplier", 1.0);
  result.offset = mimic.attribute_number("offset", 0.0);
  if (result.multiplier == 0.0) {
    mimic.fail("<mimic>: multiplier is \"0\", expected another number (or a joint of type fixed)");
  }
  return result;
}

UrdfJoint read_joint(const XmlElement& element) {
  UrdfJoint joint;
  joint.name = element.require_attribute("name");
  joint.line = element.line();
  joint.parent = element.require_child("parent").require_attribute("link");
  joint.child = element.require_child("child").require_attribute("link");
  joint.X_PJ = read_origin(element);
  const std::string type = element.require_attribute("type");
  if (type == "fixed") return joint;
  if (type == "revolute" || type == "continuous") {
    joint.type = JointType::revolute;
  } else if (type == "prismatic") {
    joint.type = JointType::prismatic;
  } else {
    element.fail("joint {}: type is \"{}\", expected one of revolute, continuous, prismatic, fixed",
                 joint.name, shown(type));
  }
  if (const XmlElement axis = element.child("axis")) {
    joint.axis_J = axis.require_attribute_vector("xyz");
    if (joint.axis_J.norm() < 1e-6) {
      axis.fail("<axis> of joint {}: xyz is \"{}\", expected a direction that is not zero", joint.name,
                axis.require_attribute("xyz"));
    }
    joint.axis_J.normalize();
  }
  read_limits(element, type, joint);
  joint.mimic = read_mimic(element);
  return joint;
}

}  // namespace

Urdf read_urdf(const fs::path& file, const fs::path& only_within) {
  const XmlFile xml(file);
  const XmlElement robot = xml.require_root("robot");
  if (robot.child("palm")) robot.fail("is a robot of GraspIt!, expected a URDF");
  Urdf urdf;
  urdf.file = file;
  urdf.name = robot.attribute("name").value_or(file.stem().string());
  std::map<std::string, int> link_lines, joint_lines;
  for (const XmlElement& element : robot.children("link")) {
    urdf.links.push_back(read_link(element, only_within));
    const auto [first, is_new] = link_lines.emplace(urdf.links.back().name, element.line());
    if (!is_new) {
      element.fail("the link \"{}\" is there already, in line {}, expected another name", first->first,
                   first->second);
    }
  }
  for (const XmlElement& element : robot.children("joint")) {
    urdf.joints.push_back(read_joint(element));
    const auto [first, is_new] = joint_lines.emplace(urdf.joints.back().name, element.line());
    if (!is_new) {
      element.fail("the joint \"{}\" is there already, in line {}, expected another name", first->first,
                   first->second);
    }
  }
  if (urdf.links.empty()) robot.fail("<robot> has no <link>, expected at least one");
  return urdf;
}

}  // namespace eigengrasp
