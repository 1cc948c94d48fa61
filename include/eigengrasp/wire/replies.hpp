// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/wire/messages.hpp"

/// The JSON bodies of HTTP answers under /api; see schema/wire.schema.json.
namespace eigengrasp::wire {

struct HandEntry {
  /// Of a degree of freedom [rad or m] or of the amplitude of an eigengrasp.
  struct Range {
    std::string name;
    double min = 0.0;
    double max = 0.0;
  };
  std::string name;
  std::string title;
  int n_dof = 0;
  int n_links = 1;
  int eigengrasps = 0;
  std::vector<std::string> links;
  LinkPoses rest;  ///< in the hand base's frame
  Point approach_point{};
  Point approach_direction{0, 0, 1};
  double reach = 0.0;
  std::vector<Range> dofs;
  std::vector<Range> amplitudes;
  bool uploaded = false;
};

struct ObjectEntry {
  std::string name;
  std::string title;
  std::int64_t triangles = 1;
  Point size{};
  Point center{};
  bool uploaded = false;
};

struct Status {
  std::string program = "eigengrasp";
  std::string version;
  int protocol = kProtocol;
  bool token_required = false;
  std::vector<HandEntry> hands;
  std::vector<ObjectEntry> objects;
  std::optional<std::string> default_hand;
  std::optional<std::string> default_object;
  Limits limits;
  bool logs = false;
};

struct UploadReply {
  std::string name;
  std::vector<std::string> warnings;
};

struct ErrorReply {
  std::string error;
};

struct LogEntry {
  std::string name;
  std::int64_t bytes = 0;
};

struct LogList {
  std::vector<LogEntry> logs;
};

}  // namespace eigengrasp::wire
