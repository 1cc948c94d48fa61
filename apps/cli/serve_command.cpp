// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <cstdio>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "server/server.hpp"

namespace eigengrasp::cli {

namespace {

void say(const server::ServerAddress& address, const std::function<void()>& /*stop*/) {
  fmt::print("eigengrasp: {}\n", address.url);
  if (address.udp_port > 0) fmt::print("trackers: UDP port {} of 127.0.0.1\n", address.udp_port);
  if (!address.app) fmt::print("the web app is not built; './run serve' builds it\n");
  fmt::print("Ctrl-C ends it\n");
  std::fflush(stdout);
}

void add_limits(CLI::App& command, server::ServerLimits& limits) {
  command.add_option("--max-clients", limits.clients, "WebSockets at a time")->group("Limits");
  command.add_option("--max-plans", limits.plans, "Plans that run at a time")->group("Limits");
  command.add_option("--max-sessions", limits.online_sessions, "Online planners at a time")->group("Limits");
  command.add_option("--max-uploads", limits.uploads, "Uploaded objects and hands that are kept")
      ->group("Limits");
  command.add_option("--max-upload", limits.upload_bytes, "Size of an upload [bytes]")->group("Limits");
  command.add_option("--max-unpacked", limits.unpacked_bytes, "Size of what a hand's archive holds [bytes]")
      ->group("Limits");
  command.add_option("--max-message", limits.message_bytes, "Size of a message [bytes]")->group("Limits");
  command.add_option("--max-rate", limits.messages_per_second, "Messages a second of a client")
      ->group("Limits");
  command.add_option("--slow-after", limits.slow_seconds, "A client that reads nothing is dropped after [s]")
      ->group("Limits");
  command.add_option("--silent-after", limits.silent_seconds, "A client that answers no ping, after [s]")
      ->group("Limits");
  command.add_option("--hello-within", limits.hello_seconds, "A client that does not say hello, after [s]")
      ->group("Limits");
}

}  // namespace

void add_serve_command(CLI::App& app) {
  auto options = std::make_shared<server::ServerOptions>();
  CLI::App* command = app.add_subcommand("serve", "Serve the web app: plan and grasp interactively");
  command->add_option("--port", options->port,
                      "Port of HTTP and WebSocket (default: 8080; 0: any that is free)");
  command->add_option("--bind", options->bind,
                      "Address to listen at (default: 127.0.0.1); another than loopback needs a --token");
  command->add_option("--token", options->token, "What clients must say, at least 8 characters");
  command->add_option("--hand", options->hand, "The app begins with this hand: a name, or a path");
  command->add_option("--object", options->object, "The app begins with this object: a name, or a mesh file");
  command->add_option("--app", options->app,
                      "Folder of the built web app (default: the installed one, or viewer/dist)");
  command->add_option("--udp", options->udp_port, "UDP port for trackers, on 127.0.0.1 (0: any)");
  command->add_option("--log", options->logs, "Folder for logs of sessions, which the app can replay");
  command->add_option("--threads", options->threads, "Threads of a plan (0: all)");
  add_limits(*command, options->limits);
  command->footer(
      "Examples:\n"
      "  eigengrasp serve\n"
      "  eigengrasp serve --hand human --object mug.stl --udp 8081 --log logs\n"
      "  eigengrasp serve --bind 0.0.0.0 --token $(openssl rand -hex 16)\n"
      "Messages: docs/wire-protocol.md; trackers: docs/trackers.md. Exit code: 0 ended by Ctrl-C, 2 bad "
      "input.");
  command->callback([options] { server::serve(*options, user_cache(), say); });
}

}  // namespace eigengrasp::cli
