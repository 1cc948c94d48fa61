// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/model_shelf.hpp"

#include <algorithm>

#include "eigengrasp/geometry/object_checks.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "eigengrasp/report/model_glb.hpp"
#include "eigengrasp/wire/message_makers.hpp"
#include "server/uploaded_hand.hpp"
#include "server/uploaded_mesh.hpp"

namespace eigengrasp::server {

namespace {

constexpr double kHandSize = 0.2;  // the usual [m]

template <typename Slots, typename NameOf>
auto& slot_of(Slots& slots, const std::string& name, const char* what, NameOf name_of) {
  for (auto& slot : slots)
    if (name_of(slot) == name) return slot;
  std::string all;
  for (const auto& slot : slots) all += (all.empty() ? "" : ", ") + name_of(slot);
  if (all.size() > 500) all = all.substr(0, 500) + ", ...";
  throw NotKnown(fmt::format("there is no {} '{}', expected one of {}", what, name.substr(0, 64), all));
}

/// The name, or the name with a number where it is taken.
template <typename Slots, typename NameOf>
std::string free_name(const Slots& slots, const std::string& wanted, NameOf name_of) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(slots.begin(), slots.end(), [&](const auto& slot) { return name_of(slot) == name; });
  };
  std::string name = wanted;
  for (int n = 2; taken(name); ++n) name = fmt::format("{}-{}", wanted, n);
  return name;
}

}  // namespace

ModelShelf::ModelShelf(const std::string& hand, const std::string& object, const ServerLimits& limits)
    : limits_(limits) {
  const auto add_hand = [&](const std::filesystem::path& path) {
    auto model = std::make_shared<HandModel>(load_hand(path));
    const auto same = [&](const HandSlot& s) { return s.model->name == model->name; };
    if (std::none_of(hands_.begin(), hands_.end(), same)) hands_.push_back({model, {}, false});
    return model->name;
  };
  if (!hand.empty()) default_hand_ = add_hand(find_hand(hand));
  for (const NamedModel& known : list_hands()) add_hand(known.path);
  const auto add_object = [&](const std::string& name, const std::filesystem::path& path) {
    const auto same = [&](const ObjectSlot& s) { return s.name == name; };
    if (std::none_of(objects_.begin(), objects_.end(), same))
      objects_.push_back({name, std::make_shared<ObjectModel>(load_object(path)), {}, false});
    return name;
  };
  if (!object.empty()) {
    const std::filesystem::path path = find_object(object);
    default_object_ = add_object(path.stem().string().substr(0, 64), path);
  }
  for (const NamedModel& known : list_objects()) add_object(known.name, known.path);
}

const ModelShelf::HandSlot& ModelShelf::hand_slot(const std::string& name) const {
  return slot_of(hands_, name, "hand", [](const HandSlot& s) { return s.model->name; });
}

const ModelShelf::ObjectSlot& ModelShelf::object_slot(const std::string& name) const {
  return slot_of(objects_, name, "object", [](const ObjectSlot& s) { return s.name; });
}

std::shared_ptr<const HandModel> ModelShelf::hand(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return hand_slot(name).model;
}

std::shared_ptr<const ObjectModel> ModelShelf::object(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return object_slot(name).model;
}

std::shared_ptr<const std::string> ModelShelf::hand_glb(const std::string& name) {
  const auto model = hand(name);
  {
    const std::lock_guard lock(mutex_);
    if (const auto& glb = hand_slot(name).glb) return glb;
  }
  auto glb = std::make_shared<const std::string>(eigengrasp::hand_glb(*model));
  const std::lock_guard lock(mutex_);
  slot_of(hands_, name, "hand", [](const HandSlot& s) { return s.model->name; }).glb = glb;
  return glb;
}

std::shared_ptr<const std::string> ModelShelf::object_glb(const std::string& name) {
  const auto model = object(name);
  {
    const std::lock_guard lock(mutex_);
    if (const auto& glb = object_slot(name).glb) return glb;
  }
  auto glb = std::make_shared<const std::string>(eigengrasp::object_glb(*model));
  const std::lock_guard lock(mutex_);
  slot_of(objects_, name, "object", [](const ObjectSlot& s) { return s.name; }).glb = glb;
  return glb;
}

std::vector<wire::HandEntry> ModelShelf::hands() const {
  const std::lock_guard lock(mutex_);
  std::vector<wire::HandEntry> entries;
  for (const HandSlot& slot : hands_) entries.push_back(wire::hand_entry(*slot.model, slot.uploaded));
  return entries;
}

std::vector<wire::ObjectEntry> ModelShelf::objects() const {
  const std::lock_guard lock(mutex_);
  std::vector<wire::ObjectEntry> entries;
  for (const ObjectSlot& slot : objects_)
    entries.push_back(wire::object_entry(slot.name, *slot.model, slot.uploaded));
  return entries;
}

void ModelShelf::require_room() const {
  const auto is_uploaded = [](const auto& slot) { return slot.uploaded; };
  const auto n = std::count_if(objects_.begin(), objects_.end(), is_uploaded) +
                 std::count_if(hands_.begin(), hands_.end(), is_uploaded);
  if (n >= limits_.uploads)
    fail(
        "{} objects and hands were uploaded, the most that are kept; start the server again, or with a "
        "larger "
        "--max-uploads",
        n);
}

wire::UploadReply ModelShelf::upload_object(const std::string& name, const std::string& units,
                                            const std::string& bytes) {
  {
    const std::lock_guard lock(mutex_);
    require_room();
  }
  const UploadedMesh mesh = read_uploaded_mesh(name, units, bytes, limits_.upload_triangles);
  wire::UploadReply reply;
  for (std::string& sentence : size_warnings(inspect_mesh(mesh.object->mesh), kHandSize))
    reply.warnings.push_back(std::move(sentence));
  const std::lock_guard lock(mutex_);
  require_room();
  reply.name = free_name(objects_, mesh.name, [](const ObjectSlot& s) { return s.name; });
  objects_.push_back({reply.name, mesh.object, {}, true});
  return reply;
}

wire::UploadReply ModelShelf::upload_hand(const std::string& name, const std::string& bytes) {
  {
    const std::lock_guard lock(mutex_);
    require_room();
  }
  UploadedHand hand = read_uploaded_hand(name, bytes, limits_);
  const std::lock_guard lock(mutex_);
  require_room();
  hand.model->name = free_name(hands_, hand.model->name, [](const HandSlot& s) { return s.model->name; });
  hands_.push_back({hand.model, {}, true});
  return {hand.model->name, std::move(hand.warnings)};
}

}  // namespace eigengrasp::server
