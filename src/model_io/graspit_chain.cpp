// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>

#include "model_io/graspit_robot.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// A joint by Denavit and Hartenberg, Rot z(theta) Trans z(d) Trans x(a) Rot x(alpha): what stands before its
/// motion and what stands after it.
struct DhJoint {
  HandJoint joint;  ///< X_PJ holds only what stands before the motion
  Pose X_after = Pose::Identity();
};

Pose rotation_z(double angle) {
  return Pose(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}
Pose translation(double x, double z) {
  return Pose(Eigen::Translation3d(x, 0.0, z));
}

void read_limits(const XmlElement& element, double unit, HandJoint& joint) {
  joint.min = unit * element.require_child("minValue").number();
  joint.max = unit * element.require_child("maxValue").number();
  if (joint.min > joint.max) {
    element.require_child("minValue")
        .fail("<minValue> is \"{}\", expected at most the <maxValue> {}", element.child("minValue").text(),
              element.child("maxValue").text());
  }
}

DhJoint read_joint(const XmlElement& element) {
  const XmlElement theta = element.require_child("theta"), d = element.require_child("d");
  const double a = metres_of_mm * element.require_child("a").number();
  const double alpha = radians_of_degree * element.require_child("alpha").number();
  const bool turns = is_graspit_coupling(theta.text()), slides = is_graspit_coupling(d.text());
  if (turns == slides) {
    element.fail(
        "<joint> has <theta> \"{}\" and <d> \"{}\", expected a degree of freedom such as d0 in one "
        "of them",
        shown(theta.text()), shown(d.text()));
  }
  const GraspitCoupling coupling = read_graspit_coupling(turns ? theta : d);
  DhJoint dh;
  dh.joint.type = turns ? JointType::revolute : JointType::prismatic;
  dh.joint.dof = coupling.dof;
  dh.joint.ratio = coupling.ratio;
  // The file's limits are those of the value without the offset.
  read_limits(element, turns ? radians_of_degree : metres_of_mm, dh.joint);
  dh.X_after = translation(a, 0.0) * Pose(Eigen::AngleAxisd(alpha, Vec3::UnitX()));
  if (turns) {
    dh.joint.X_PJ = rotation_z(radians_of_degree * coupling.offset);
    dh.X_after = translation(0.0, metres_of_mm * d.number()) * dh.X_after;
  } else {
    dh.joint.X_PJ =
        rotation_z(radians_of_degree * theta.number()) * translation(0.0, metres_of_mm * coupling.offset);
  }
  return dh;
}

int joints_of_link(const XmlElement& link) {
  const std::string type = link.require_attribute("dynamicJointType");
  if (type == "Revolute" || type == "Prismatic") return 1;
  if (type == "Universal") return 2;
  if (type == "Ball") return 3;
  if (type == "Fixed") return 0;
  link.fail("<link>: dynamicJointType is \"{}\", expected one of Revolute, Prismatic, Universal, Ball, Fixed",
            shown(type));
}

/// Appends joints and links of one chain behind the palm.
class ChainBuilder {
 public:
  ChainBuilder(GraspitRobot& out, int chain) : out_(out), chain_(chain) {}

  void start_at(const Pose& X_palm_chain) { X_before_ = X_palm_chain; }

  void add_joint(const XmlElement& element, HandLink link) {
    DhJoint dh = read_joint(element);
    if (dh.joint.dof >= out_.hand.n_dof()) {
      element.fail("<joint> is driven by d{}, but the robot has {} <dof>, expected d0 to d{}", dh.joint.dof,
                   out_.hand.n_dof(), out_.hand.n_dof() - 1);
    }
    dh.joint.name = fmt::format("chain{}_joint{}", chain_, n_joints_++);
    dh.joint.parent_link = link_;
    dh.joint.X_PJ = X_before_ * dh.joint.X_PJ;
    out_.hand.joints.push_back(dh.joint);
    out_.hand.links.push_back(std::move(link));
    link_ = out_.hand.n_links() - 1;
    X_before_ = dh.X_after;
  }

  /// A link that no joint moves: it stands where the link before it stands.
  void add_fixed(HandLink link) {
    HandJoint joint;
    joint.name = fmt::format("chain{}_fixed{}", chain_, out_.hand.n_joints());
    joint.type = JointType::fixed;
    joint.parent_link = link_;
    joint.X_PJ = X_before_;
    out_.hand.joints.push_back(joint);
    out_.hand.links.push_back(std::move(link));
  }

  const Pose& X_before() const { return X_before_; }
  int n_joints() const { return n_joints_; }

 private:
  GraspitRobot& out_;
  int chain_;
  int link_ = 0;  ///< the last link that moves
  int n_joints_ = 0;
  Pose X_before_ = Pose::Identity();  ///< from the frame of link_ to where the next joint starts
};

HandLink empty_link(std::string name) {
  return {.name = std::move(name), .mesh = {}, .material = {}, .mass = 0.0};
}

/// Appends a link of GraspIt! with the joints that end in it.
void add_link(const XmlElement& element, const std::vector<XmlElement>& joints, const std::string& name,
              const std::function<HandLink(const Pose&)>& read_link, ChainBuilder& builder,
              GraspitRobot& out) {
  const int count = joints_of_link(element);
  if (builder.n_joints() + count > static_cast<int>(joints.size())) {
    element.fail("<link> is moved by {} more joints, but the chain has only {} <joint> in all", count,
                 joints.size());
  }
  if (count == 0) {
    HandLink link = read_link(Pose::Identity());
    link.name = name;
    builder.add_fixed(std::move(link));
    out.chains.back().push_back({out.hand.n_links() - 1, Pose::Identity()});
  } else {
    for (int k = 0; k + 1 < count; ++k) {  // links between the joints of a Universal or Ball joint
      const int j = builder.n_joints();
      builder.add_joint(joints[static_cast<std::size_t>(j)], empty_link(fmt::format("{}_axis{}", name, k)));
    }
    builder.add_joint(joints[static_cast<std::size_t>(builder.n_joints())], empty_link(name));
    HandLink link = read_link(builder.X_before());
    link.name = name;
    out.hand.links.back() = std::move(link);
    out.chains.back().push_back({out.hand.n_links() - 1, builder.X_before()});
  }
  out.hand.frames.push_back({name, out.chains.back().back().link, out.chains.back().back().X_LG});
}

}  // namespace

HandLink read_graspit_link(const XmlElement& element, const std::filesystem::path& body_folder,
                           bool with_meshes, const Pose& X_LG, GraspitRobot& out) {
  const auto file = body_folder / element.require_text();
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec)) {
    element.fail("<{}> is \"{}\", but {} does not exist", element.name(), shown(element.text()),
                 file.string());
  }
  auto body = out.bodies.find(file.string());
  if (body == out.bodies.end()) {
    body = out.bodies.emplace(file.string(), read_graspit_body(file, metres_of_mm, with_meshes)).first;
  }
  HandLink link;
  link.mesh = body->second.mesh;
  transform(link.mesh, X_LG);
  link.material = {body->second.material, std::nullopt, body->second.youngs_modulus};
  link.mass = body->second.mass;
  return link;
}

void read_graspit_chain(const XmlElement& chain, const std::filesystem::path& body_folder, bool with_meshes,
                        GraspitRobot& out) {
  const int index = static_cast<int>(out.chains.size());
  out.chains.emplace_back();
  ChainBuilder builder(out, index);
  if (const XmlElement transform = chain.child("transform")) {
    builder.start_at(read_graspit_transform(transform));
  }
  const auto joints = chain.children("joint");
  const auto links = chain.children("link");
  if (links.empty()) chain.fail("<chain> has no <link>, expected at least one");
  for (std::size_t l = 0; l < links.size(); ++l) {
    const auto read_link = [&](const Pose& X_LG) {
      return read_graspit_link(links[l], body_folder, with_meshes, X_LG, out);
    };
    add_link(links[l], joints, fmt::format("chain{}_link{}", index, l), read_link, builder, out);
  }
  if (builder.n_joints() != static_cast<int>(joints.size())) {
    joints[static_cast<std::size_t>(builder.n_joints())].fail(
        "<joint> moves no link: the chain has {} joints, but its links use {}", joints.size(),
        builder.n_joints());
  }
}

}  // namespace eigengrasp
