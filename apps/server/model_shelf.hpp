// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"
#include "eigengrasp/wire/replies.hpp"
#include "server/server_options.hpp"

namespace eigengrasp::server {

/// A name that is on no list; the sentence lists those that are.
class NotKnown : public Error {
 public:
  using Error::Error;
};

/// Hands and objects that clients can name: those that the program knows, and what was uploaded. From any
/// thread.
class ModelShelf {
 public:
  /// Loads everything. Hand and object may be paths; they come first, and default_hand and default_object
  /// name them. @throws Error for one that cannot be read.
  ModelShelf(const std::string& hand, const std::string& object, const ServerLimits& limits);

  std::shared_ptr<const HandModel> hand(const std::string& name) const;      ///< @throws NotKnown
  std::shared_ptr<const ObjectModel> object(const std::string& name) const;  ///< @throws NotKnown
  std::shared_ptr<const std::string> hand_glb(const std::string& name);      ///< @throws NotKnown
  std::shared_ptr<const std::string> object_glb(const std::string& name);    ///< @throws NotKnown

  std::vector<wire::HandEntry> hands() const;
  std::vector<wire::ObjectEntry> objects() const;
  const std::string& default_hand() const { return default_hand_; }
  const std::string& default_object() const { return default_object_; }

  /// Takes a mesh file in. @param name with its ending  @param units m, cm, mm or in
  /// @throws Error, one sentence.
  wire::UploadReply upload_object(const std::string& name, const std::string& units,
                                  const std::string& bytes);
  /// Takes the archive of a hand's folder in. @param name with its ending  @throws Error, one sentence.
  wire::UploadReply upload_hand(const std::string& name, const std::string& bytes);

 private:
  struct HandSlot {
    std::shared_ptr<const HandModel> model;
    std::shared_ptr<const std::string> glb;
    bool uploaded = false;
  };
  struct ObjectSlot {
    std::string name;
    std::shared_ptr<const ObjectModel> model;
    std::shared_ptr<const std::string> glb;
    bool uploaded = false;
  };
  const HandSlot& hand_slot(const std::string& name) const;
  const ObjectSlot& object_slot(const std::string& name) const;
  void require_room() const;  ///< @pre mutex_ is held  @throws Error where no more uploads are kept

  ServerLimits limits_;
  mutable std::mutex mutex_;
  std::vector<HandSlot> hands_;
  std::vector<ObjectSlot> objects_;
  std::string default_hand_;
  std::string default_object_;
};

}  // namespace eigengrasp::server
