// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/api.hpp"

#include <algorithm>
#include <filesystem>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/version.hpp"
#include "eigengrasp/wire/wire_text.hpp"
#include "server/web_address.hpp"

namespace eigengrasp::server {

namespace {

constexpr const char* kObjectsPath = "/api/objects";
constexpr const char* kHandsPath = "/api/hands";
constexpr const char* kStatusPath = "/api/status";

/// The parts of a path between slashes.
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t begin = 1; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    parts.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

HttpReply nothing_here() {
  return refusal(404, "there is nothing at this path; docs/wire-protocol.md lists what the server has");
}

std::string value_or_empty(const HttpRequest& request, const std::string& key) {
  const auto found = request.query.find(key);
  return found == request.query.end() ? "" : found->second;
}

}  // namespace

bool Api::has_token(const HttpRequest& request) const {
  const std::string& token = services_.options.token;
  if (token.empty()) return true;
  constexpr std::string_view scheme = "Bearer ";
  if (request.authorization.starts_with(scheme) &&
      equal_in_constant_time(std::string_view(request.authorization).substr(scheme.size()), token))
    return true;
  return equal_in_constant_time(value_or_empty(request, "token"), token);
}

std::optional<HttpReply> Api::admit(const HttpRequest& request) const {
  if (!is_own_host(request.host, services_.options.bind))
    return refusal(403, fmt::format("found the host '{}', expected localhost or 127.0.0.1",
                                    request.host.substr(0, 100)));
  if (!is_own_origin(request.origin, request.host))
    return refusal(403, fmt::format("found a page of the origin '{}', expected the server's own or loopback",
                                    request.origin.substr(0, 100)));
  if (request.path == "/ws") {
    if (!request.websocket) return refusal(426, "expected a WebSocket at /ws");
    return {};
  }
  if (request.websocket) return refusal(404, "there is no WebSocket here, expected /ws");
  if (request.method != "GET" && !takes_body(request))
    return refusal(405, fmt::format("found the method {}, expected GET; uploads are a POST to {} or {}",
                                    request.method.substr(0, 20), kObjectsPath, kHandsPath));
  if (request.path.starts_with("/api/") && request.path != kStatusPath && !has_token(request))
    return refusal(401, "the token is missing or not the server's, expected 'Authorization: Bearer TOKEN'");
  return {};
}

bool Api::takes_body(const HttpRequest& request) const {
  return request.method == "POST" && (request.path == kObjectsPath || request.path == kHandsPath);
}

HttpReply Api::answer(const HttpRequest& request) {
  if (!request.path.starts_with("/api/")) return files_.reply(request.path);
  if (request.path == kStatusPath) return status(request);
  if (takes_body(request)) return upload(request, request.path == kHandsPath);
  const std::vector<std::string> parts = parts_of(request.path);
  try {
    if (parts.size() == 4 && parts[1] == "hands" && parts[3] == "model.glb")
      return {200, "model/gltf-binary", *services_.shelf.hand_glb(parts[2]), ""};
    if (parts.size() == 4 && parts[1] == "objects" && parts[3] == "model.glb")
      return {200, "model/gltf-binary", *services_.shelf.object_glb(parts[2]), ""};
  } catch (const NotKnown& e) {
    return refusal(404, e.what());
  }
  if (parts.size() == 4 && parts[1] == "plans") return services_.plans.file(parts[2], parts[3]);
  if (parts.size() == 2 && parts[1] == "logs") return logs();
  if (parts.size() == 3 && parts[1] == "logs") return log(parts[2]);
  return nothing_here();
}

HttpReply Api::status(const HttpRequest& request) const {
  wire::Status status;
  status.version = version();
  status.token_required = !services_.options.token.empty();
  status.limits = services_.wire_limits();
  status.logs = !services_.options.logs.empty();
  if (has_token(request)) {
    status.hands = services_.shelf.hands();
    status.objects = services_.shelf.objects();
    if (const auto& hand = services_.shelf.default_hand(); !hand.empty()) status.default_hand = hand;
    if (const auto& object = services_.shelf.default_object(); !object.empty())
      status.default_object = object;
  }
  return {200, "application/json", wire::to_text(status), ""};
}

HttpReply Api::upload(const HttpRequest& request, bool hand) {
  const std::string name = value_or_empty(request, "name");
  if (name.empty() || name.size() > 200)
    return refusal(400, fmt::format("the query has no name, expected ?name={} with at most 200 characters",
                                    hand ? "HAND.zip" : "FILE.stl&units=mm"));
  if (request.body.empty())
    return refusal(400, fmt::format("the body is empty, expected {}", hand ? "an archive" : "a mesh file"));
  ModelShelf& shelf = services_.shelf;
  const wire::UploadReply reply =
      hand ? shelf.upload_hand(name, request.body)
           : shelf.upload_object(name, value_or_empty(request, "units"), request.body);
  return {200, "application/json", wire::to_text(reply), ""};
}

HttpReply Api::logs() const {
  wire::LogList list;
  if (services_.options.logs.empty())
    return refusal(404, "no logs are kept; start the server with --log FOLDER");
  for (const auto& entry : std::filesystem::directory_iterator(services_.options.logs))
    if (entry.is_regular_file() && entry.path().extension() == ".jsonl" && list.logs.size() < 10000)
      list.logs.push_back(
          {entry.path().filename().string().substr(0, 64), static_cast<std::int64_t>(entry.file_size())});
  std::sort(list.logs.begin(), list.logs.end(), [](const auto& a, const auto& b) { return a.name > b.name; });
  return {200, "application/json", wire::to_text(list), ""};
}

HttpReply Api::log(const std::string& name) const {
  if (!services_.options.logs.empty())
    for (const auto& entry : std::filesystem::directory_iterator(services_.options.logs))
      if (entry.is_regular_file() && entry.path().extension() == ".jsonl" && entry.path().filename() == name)
        return {200, "application/jsonl", read_text_file(entry.path()), name};
  return refusal(404, "there is no such log; /api/logs lists them");
}

}  // namespace eigengrasp::server
