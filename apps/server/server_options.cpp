// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/server_options.hpp"

#include <fmt/format.h>

#include "server/web_address.hpp"

namespace eigengrasp::server {

std::vector<std::string> ServerOptions::validate() const {
  std::vector<std::string> violations;
  const auto require = [&](bool sound, std::string sentence) {
    if (!sound) violations.push_back(std::move(sentence));
  };
  const auto at_least_one = [&](const char* option, auto value) {
    require(value >= 1, fmt::format("{} is {}, expected 1 or more", option, value));
  };
  require(port >= 0 && port <= 65535, fmt::format("--port is {}, expected 0 (any) to 65535", port));
  require(!udp_port || (*udp_port >= 0 && *udp_port <= 65535),
          fmt::format("--udp is {}, expected 0 (any) to 65535", udp_port.value_or(0)));
  require(
      is_loopback(bind) || !token.empty(),
      fmt::format("--bind is {}, which others can reach; expected a --token beside it, or --bind 127.0.0.1",
                  bind));
  require(token.empty() || token.size() >= 8,
          fmt::format("--token has {} characters, expected 8 to 256, such as of 'openssl rand -hex 16'",
                      token.size()));
  require(token.size() <= 256, fmt::format("--token has {} characters, expected 8 to 256", token.size()));
  require(threads >= 0 && threads <= 4096, fmt::format("--threads is {}, expected 0 (all) to 4096", threads));
  at_least_one("--max-clients", limits.clients);
  at_least_one("--max-plans", limits.plans);
  at_least_one("--max-sessions", limits.online_sessions);
  at_least_one("--max-upload", limits.upload_bytes);
  at_least_one("--max-unpacked", limits.unpacked_bytes);
  at_least_one("--max-message", limits.message_bytes);
  at_least_one("--max-rate", limits.messages_per_second);
  require(limits.uploads >= 0, fmt::format("--max-uploads is {}, expected 0 or more", limits.uploads));
  return violations;
}

}  // namespace eigengrasp::server
