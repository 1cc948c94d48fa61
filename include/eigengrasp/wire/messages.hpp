// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/online/online_view.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

/// What goes over the wire between `eigengrasp serve`, the web app and trackers: one struct for each entry of
/// schema/wire.schema.json, whose descriptions say what the members mean. docs/wire-protocol.md explains the
/// flow. Plain data; a member that is optional is left out of the text where it has no value.
namespace eigengrasp::wire {

inline constexpr int kProtocol = 1;

/// x, y, z [m], then quaternion w, x, y, z, in the object frame.
using PoseNumbers = std::array<double, 7>;
using Point = std::array<double, 3>;
using LinkPoses = std::vector<PoseNumbers>;

enum class Role { app, tracker };
enum class ErrorCode {
  bad_message,
  too_large,
  too_fast,
  not_allowed,
  not_known,
  no_session,
  busy,
  failed,
};

// What clients send.

struct Hello {
  static constexpr const char* type = "hello";
  int protocol = kProtocol;
  Role role = Role::app;
  std::optional<std::string> token;
  std::optional<std::string> session;
};

struct PlanStart {
  static constexpr const char* type = "plan.start";
  struct Options {
    std::int64_t iterations = PlanOptions{}.iterations;
    int grasps = PlanOptions{}.grasps;
    std::uint64_t seed = PlanOptions{}.seed;
    SearchKind search = PlanOptions{}.search;
    EnergyKind energy = PlanOptions{}.energy;
    int amplitudes = PlanOptions{}.amplitudes;
    std::optional<double> friction;
  };
  std::string hand;
  std::string object;
  double scale = 1.0;
  bool table = false;
  Options options;
};

struct PlanStop {
  static constexpr const char* type = "plan.stop";
};

struct OnlineStart {
  static constexpr const char* type = "online.start";
  struct Options {
    std::uint64_t seed = OnlineOptions{}.seed;
    int amplitudes = OnlineOptions{}.amplitudes;
    double cone_half_angle = OnlineOptions{}.cone_half_angle;
    double look_ahead = OnlineOptions{}.look_ahead;
    double step_back = OnlineOptions{}.step_back;
    double epsilon_min = OnlineOptions{}.epsilon_min;
    double preshape_begins = OnlineOptions{}.preshape_begins;
    std::optional<double> friction;
  };
  std::string hand;
  std::string object;
  double scale = 1.0;
  bool table = false;
  Options options;
};

struct OnlineStop {
  static constexpr const char* type = "online.stop";
};

struct Wrist {
  static constexpr const char* type = "wrist";
  double time = 0.0;
  PoseNumbers pose{0, 0, 0, 1, 0, 0, 0};
  std::optional<std::string> session;
};

struct Target {
  VariableTarget::Variable variable = VariableTarget::Variable::amplitude;
  int index = 0;
  double value = 0.0;
  double confidence = 1.0;
};

struct Targets {
  static constexpr const char* type = "targets";
  std::vector<Target> targets;
  std::optional<std::string> session;
};

struct Command {
  static constexpr const char* type = "command";
  OperatorCommand command = OperatorCommand::close;
  std::optional<std::string> session;
};

struct SolutionGet {
  static constexpr const char* type = "solution.get";
  std::uint64_t id = 0;
};

using ClientMessage =
    std::variant<Hello, PlanStart, PlanStop, OnlineStart, OnlineStop, Wrist, Targets, Command, SolutionGet>;

// What the server sends.

struct Limits {
  std::int64_t message_bytes = 1;
  std::int64_t messages_per_second = 1;
  std::int64_t upload_bytes = 1;
  std::int64_t uploads = 0;
};

struct Welcome {
  static constexpr const char* type = "welcome";
  std::string program = "eigengrasp";
  std::string version;
  int protocol = kProtocol;
  Role role = Role::app;
  std::optional<std::string> session;
  Limits limits;
};

struct ErrorMessage {
  static constexpr const char* type = "error";
  ErrorCode code = ErrorCode::failed;
  std::string message;
  std::optional<std::string> of;
};

struct Contact {
  Point point{};
  Point normal{};
  double friction = 0.0;
  double torsion_length = 0.0;
  std::string link;
  int patch = 0;
};

struct GraspShape {
  bool form_closure = false;
  double epsilon = 0.0;
  double volume = 0.0;
  double energy = 0.0;
  double max_penetration = 0.0;
  std::vector<LinkPoses> closing;
  std::vector<Contact> contacts;
};

struct PlanStarted {
  static constexpr const char* type = "plan.started";
  std::string id;
  std::string hand;
  std::string object;
};

struct PlanProgressMessage {
  static constexpr const char* type = "plan.progress";
  std::string id;
  std::int64_t iterations = 0;
  std::int64_t total = 0;
  double seconds = 0.0;
  std::optional<double> best_energy;
};

struct PlanMilestone {
  static constexpr const char* type = "plan.milestone";
  std::string id;
  std::int64_t iteration = 0;
  double energy = 0.0;
  LinkPoses link_poses;
};

struct PlanResultMessage {
  static constexpr const char* type = "plan.result";
  struct Counts {
    std::int64_t states = 0, legal = 0, tested = 0, form_closed = 0, not_closed = 0, no_contact = 0,
                 penetrating = 0;
  };
  struct Timings {
    double prepare = 0.0, search = 0.0, close = 0.0, volume = 0.0, total = 0.0;
  };
  std::string id;
  PlanStatus status = PlanStatus::nothing_legal;
  bool stopped_early = false;
  std::string explanation;
  std::vector<GraspShape> grasps;
  Counts counts;
  Timings timings;
};

struct OnlineReady {
  static constexpr const char* type = "online.ready";
  std::string session;
  std::string hand;
  std::string object;
  std::optional<double> table_height;
  double seconds = 0.0;
};

struct OnlineStopped {
  static constexpr const char* type = "online.stopped";
  std::string session;
};

struct View {
  static constexpr const char* type = "view";
  struct Sample {
    double time = 0.0;
    PoseNumbers pose{0, 0, 0, 1, 0, 0, 0};
  };
  struct Offer {
    std::uint64_t id = 0;
    LinkPoses pregrasp;
    LinkPoses grasp;
  };
  struct Cone {
    Point apex{};
    Point axis{0, 0, 1};
    double half_angle = 0.0;
    double nearest = 0.0;
    double farthest = 0.0;
  };
  std::uint64_t frame = 0;
  double time = 0.0;
  OnlinePhase phase = OnlinePhase::waiting;
  std::optional<Sample> wrist;
  bool blocked = false;
  LinkPoses link_poses;
  double preshape = 0.0;
  std::optional<Offer> offer;
  std::vector<OnlineSolution> solutions;
  Cone cone;
  OnlineRates rates;
  std::optional<double> epsilon_now;
  std::optional<double> server_ms;
  std::string message;
};

struct Closed {
  static constexpr const char* type = "closed";
  std::optional<GraspShape> grasp;
  std::string message;
};

struct SolutionReply {
  static constexpr const char* type = "solution";
  std::uint64_t id = 0;
  std::optional<GraspShape> grasp;
};

using ServerMessage =
    std::variant<Welcome, ErrorMessage, PlanStarted, PlanProgressMessage, PlanMilestone, PlanResultMessage,
                 OnlineReady, OnlineStopped, View, Closed, SolutionReply>;

}  // namespace eigengrasp::wire
