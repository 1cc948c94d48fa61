// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/prepared_parts.hpp"

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/geometry/point_cloud.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp {

namespace {

CollisionModel::Options one_thread() {
  CollisionModel::Options options;
  options.threads = 1;
  return options;
}

}  // namespace

std::filesystem::path geometry_file(const StoredModel& model) {
  if (!model.geometry_path.starts_with(kLibraryPath)) return model.geometry_path;
  return find_library_object(model.geometry_path.substr(std::string_view(kLibraryPath).size()));
}

namespace {

std::filesystem::path unchanged_file(const StoredModel& model) {
  const std::filesystem::path file = geometry_file(model);
  if (content_hash(read_text_file(file)) != model.content_hash)
    fail("{}: has changed since it was added to the store", file.string());
  return file;
}

ObjectReadOptions read_options(const StoredModel& model) {
  ObjectReadOptions options;
  options.units = "m";
  options.later_scale = model.rescale;
  return options;
}

void require_surface(const TriangleMesh& mesh, const std::filesystem::path& file) {
  if (inspect_mesh(mesh).degenerate_triangles >= static_cast<int>(mesh.triangles.size()))
    fail("{}: none of its {} triangles has an area, expected a surface", file.string(),
         mesh.triangles.size());
}

}  // namespace

TriangleMesh load_stored_mesh(const StoredModel& model) {
  const std::filesystem::path file = unchanged_file(model);
  TriangleMesh mesh = is_mesh_file(file) && !is_point_cloud_file(file)
                          ? load_mesh(file, {.scale = 1.0, .later_scale = model.rescale})
                          : load_object(file, read_options(model)).mesh;
  require_surface(mesh, file);
  transform(mesh, Pose::Identity(), model.rescale);
  return mesh;
}

ObjectModel load_stored_object(const StoredModel& model) {
  const std::filesystem::path file = unchanged_file(model);
  const ObjectModel in_units = load_object(file, read_options(model));
  TriangleMesh mesh = in_units.mesh;
  require_surface(mesh, file);
  transform(mesh, Pose::Identity(), model.rescale);
  const Vec3 center = model.rescale * in_units.center_of_mass;
  ObjectModel object = make_object(model.name, std::move(mesh), &center);
  object.source = file;
  object.material = in_units.material;
  return object;
}

PreparedHand prepare_hand(std::shared_ptr<const HandModel> hand, int threads, PreparationCache* cache) {
  auto surfaces =
      std::make_shared<const HandSurfaces>(*hand, CollisionModel::Options{}.cover_tolerance, threads, cache);
  return {std::move(hand), std::move(surfaces)};
}

StoredHand hand_record(const HandModel& hand) {
  StoredHand record;
  record.name = hand.name;
  for (const HandJoint& joint : hand.joints)
    if (joint.type != JointType::fixed) record.joints.push_back(joint.name);
  for (const HandDof& dof : hand.dofs) record.dofs.push_back(dof.name);
  for (const HandLink& link : hand.links) record.links.push_back(link.name);
  return record;
}

PreparedObject::PreparedObject(const StoredModel& model)
    : at_one_(std::make_shared<const ObjectModel>(load_stored_object(model))) {
  DistanceFieldOptions options;
  options.threads = 1;
  field_ = make_object_field(*at_one_, options);
}

const std::shared_ptr<const ObjectModel>& PreparedObject::at(double scale) {
  if (scale == 1.0) return at_one_;
  auto& scaled = scaled_[scale];
  if (!scaled) scaled = std::make_shared<const ObjectModel>(rescaled(*at_one_, scale));
  return scaled;
}

std::unique_ptr<const CollisionModel> PreparedObject::collision_model(const PreparedHand& hand,
                                                                      double scale) {
  Scene scene;
  scene.hand = hand.model;
  scene.object = at(scale);
  scene.object_material.name = scene.object->material;
  return std::make_unique<const CollisionModel>(
      std::move(scene), one_thread(), CollisionModel::Prepared{hand.surfaces, field_.scaled(scale)});
}

}  // namespace eigengrasp
