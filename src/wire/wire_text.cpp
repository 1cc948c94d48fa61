// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/wire/wire_text.hpp"

#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "wire/json_fields.hpp"
#include "wire/json_input.hpp"

namespace eigengrasp::wire {

namespace {

using nlohmann::json;

/// The alternative whose type the object names. @pre the schema holds the object sound
template <typename Variant, std::size_t i = 0>
Variant read_alternative(const json& object) {
  if constexpr (i < std::variant_size_v<Variant>) {
    using Message = std::variant_alternative_t<i, Variant>;
    if (object["type"] != Message::type) return read_alternative<Variant, i + 1>(object);
    Message message;
    read_value(object, message);
    return message;
  } else {
    throw std::logic_error("the schema allows a message that the program does not know");
  }
}

template <typename Variant>
std::string written_message(const Variant& variant) {
  return std::visit(
      [](const auto& message) {
        nlohmann::ordered_json object{{"type", message.type}};
        FieldWriter writer(object);
        fields(writer, const_cast<std::remove_cvref_t<decltype(message)>&>(message));
        return object.dump(-1, ' ', false, json::error_handler_t::replace);
      },
      variant);
}

template <typename T>
std::string written_reply(const T& reply) {
  return written_value(reply).dump(-1, ' ', false, json::error_handler_t::replace);
}

void require_unit_quaternion(const PoseNumbers& pose) {
  const double length =
      std::sqrt(pose[3] * pose[3] + pose[4] * pose[4] + pose[5] * pose[5] + pose[6] * pose[6]);
  if (!(std::abs(length - 1.0) <= 0.01))
    fail("wrist: pose: found a quaternion (w, x, y, z) of length {:.4g}, expected length 1", length);
}

}  // namespace

ClientMessage parse_client_message(std::string_view text, const TextLimits& limits) {
  ClientMessage message = read_alternative<ClientMessage>(checked_json(text, "ClientMessage", limits));
  if (const auto* wrist = std::get_if<Wrist>(&message)) require_unit_quaternion(wrist->pose);
  return message;
}

ServerMessage parse_server_message(std::string_view text, const TextLimits& limits) {
  return read_alternative<ServerMessage>(checked_json(text, "ServerMessage", limits));
}

std::string to_text(const ClientMessage& message) {
  return written_message(message);
}
std::string to_text(const ServerMessage& message) {
  return written_message(message);
}
std::string to_text(const Status& reply) {
  return written_reply(reply);
}
std::string to_text(const UploadReply& reply) {
  return written_reply(reply);
}
std::string to_text(const ErrorReply& reply) {
  return written_reply(reply);
}
std::string to_text(const LogList& reply) {
  return written_reply(reply);
}

std::string_view type_of(const ClientMessage& message) {
  return std::visit([](const auto& m) -> std::string_view { return m.type; }, message);
}
std::string_view type_of(const ServerMessage& message) {
  return std::visit([](const auto& m) -> std::string_view { return m.type; }, message);
}

}  // namespace eigengrasp::wire
