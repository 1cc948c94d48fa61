// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// From a URDF to a hand: links without a surface behind fixed joints become frames.
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "model_io/hand_assembly.hpp"
#include "model_io/primitive_meshes.hpp"
#include "model_io/text_values.hpp"
#include "model_io/urdf_reader.hpp"

namespace eigengrasp {

namespace {

/// Where a link of the URDF went: a link of the hand, and the URDF link's frame F in it.
struct Place {
  int link = 0;
  Pose X_LF = Pose::Identity();
};

TriangleMesh load_shape_mesh(const UrdfShape& shape) {
  const std::string ending = lower_extension(shape.file.string());
  TriangleMesh mesh =
      ending == ".iv" || ending == ".wrl" ? load_inventor(shape.file, 1.0) : load_mesh(shape.file);
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(shape.size);
  if (shape.size.prod() < 0.0) {  // mirrored: turn the triangles round
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

TriangleMesh load_shape(const UrdfShape& shape, std::map<std::string, TriangleMesh>& cache) {
  switch (shape.kind) {
    case UrdfShape::Kind::box:
      return box_mesh(shape.size);
    case UrdfShape::Kind::cylinder:
      return cylinder_mesh(shape.size[0], shape.size[1]);
    case UrdfShape::Kind::sphere:
      return sphere_mesh(shape.size[0]);
    case UrdfShape::Kind::mesh:
      break;
  }
  const std::string key =
      fmt::format("{} {} {} {}", shape.file.string(), shape.size[0], shape.size[1], shape.size[2]);
  const auto known = cache.find(key);
  if (known != cache.end()) return known->second;
  return cache.emplace(key, load_shape_mesh(shape)).first->second;
}

const UrdfLink& link_named(const Urdf& urdf, const std::string& name) {
  for (const UrdfLink& link : urdf.links)
    if (link.name == name) return link;
  throw std::logic_error("no link " + name);
}

/// Degrees of freedom, and of every joint how it follows one of them.
void couple_joints(const Urdf& urdf, HandModel& hand) {
  const auto mimics = resolve_mimics(urdf);
  std::map<std::string, int> dof_of;
  for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
    const UrdfJoint& joint = urdf.joints[j];
    if (joint.type == JointType::fixed || mimics[j]) continue;
    dof_of[joint.name] = hand.n_dof();
    hand.dofs.push_back({.name = joint.name});
  }
  for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
    const UrdfJoint& joint = urdf.joints[j];
    const int found = hand.find_joint(joint.name);
    if (joint.type == JointType::fixed || found < 0) continue;
    HandJoint& moved = hand.joints[static_cast<std::size_t>(found)];
    moved.dof = dof_of.at(mimics[j] ? mimics[j]->joint : joint.name);
    if (mimics[j]) {
      moved.ratio = mimics[j]->multiplier;
      moved.offset = mimics[j]->offset;
    }
  }
  const int bad = set_dof_limits(hand);
  if (bad < 0) return;
  const std::string& name = hand.dofs[static_cast<std::size_t>(bad)].name;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.name != name) continue;
    fail_at(urdf.file, joint.line,
            "joint {}: its limits and those of the joints that mimic it have no value in common, expected a "
            "range",
            name);
  }
}

}  // namespace

TriangleMesh load_urdf_shapes(const UrdfLink& link, std::map<std::string, TriangleMesh>& cache) {
  TriangleMesh all;
  for (const UrdfShape& shape : link.shapes) {
    TriangleMesh mesh = load_shape(shape, cache);
    transform(mesh, shape.X_LS);
    append(all, mesh);
  }
  return all;
}

HandModel build_urdf_hand(const Urdf& urdf, bool load_meshes) {
  HandModel hand;
  hand.name = urdf.name;
  hand.source = urdf.file;
  std::map<std::string, TriangleMesh> cache;
  const auto add_link = [&](const UrdfLink& link) {
    TriangleMesh mesh = load_meshes ? load_urdf_shapes(link, cache) : TriangleMesh();
    hand.links.push_back({.name = link.name, .mesh = std::move(mesh), .material = {}, .mass = link.mass});
  };
  int root = 0;
  const std::vector<int> order = order_joints(urdf, root);
  add_link(urdf.links[static_cast<std::size_t>(root)]);
  std::map<std::string, Place> places{{hand.links[0].name, Place{}}};
  for (const int j : order) {
    const UrdfJoint& joint = urdf.joints[static_cast<std::size_t>(j)];
    const UrdfLink& child = link_named(urdf, joint.child);
    const Place parent = places.at(joint.parent);
    const Pose X_PJ = parent.X_LF * joint.X_PJ;
    if (joint.type == JointType::fixed && child.shapes.empty()) {
      places[child.name] = {parent.link, X_PJ};
      hand.frames.push_back({child.name, parent.link, X_PJ});
      hand.links[static_cast<std::size_t>(parent.link)].mass += child.mass;
      continue;
    }
    hand.joints.push_back({.name = joint.name,
                           .type = joint.type,
                           .parent_link = parent.link,
                           .X_PJ = X_PJ,
                           .axis_J = joint.axis_J,
                           .min = joint.lower,
                           .max = joint.upper});
    add_link(child);
    places[child.name] = {hand.n_links() - 1, Pose::Identity()};
  }
  couple_joints(urdf, hand);
  return hand;
}

}  // namespace eigengrasp
