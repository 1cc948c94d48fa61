// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace eigengrasp::server {

/// Whether a host (a name or an address, without port) is this machine alone: localhost, 127.x.y.z, ::1.
bool is_loopback(std::string_view host);

/// The host of "host", "host:port" or "[v6]:port".
std::string_view host_of(std::string_view authority);

/// Whether a page of this origin may talk to the server: no origin (no browser), a loopback origin, or the
/// host and port that the request itself names.
/// @param origin of the header Origin, empty where there is none  @param host of the header Host
bool is_own_origin(std::string_view origin, std::string_view host);

/// Whether the header Host names the server: a server on loopback answers to loopback names alone, so that no
/// foreign name that resolves to this machine (DNS rebinding) reaches it.
bool is_own_host(std::string_view host, std::string_view bind);

/// Text with %XX decoded; none where it is not sound, or holds a zero byte.
std::optional<std::string> percent_decoded(std::string_view text);

/// "/path?a=b&c" taken apart and decoded.
struct Target {
  std::string path;
  std::map<std::string, std::string> query;
};
/// None where it is not a path, or not sound.
std::optional<Target> parse_target(std::string_view target);

/// Whether two texts are equal, in a time that does not tell where they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace eigengrasp::server
