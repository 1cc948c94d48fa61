// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <string_view>

#include "eigengrasp/wire/messages.hpp"
#include "eigengrasp/wire/replies.hpp"

namespace eigengrasp::wire {

/// What a text may cost.
struct TextLimits {
  std::size_t bytes = 65536;
  int depth = 12;  ///< of arrays and objects in each other
};
/// What suffices for everything that the server sends.
inline constexpr TextLimits kServerText{64u << 20, 12};

/// Reads a message that is sound by schema/wire.schema.json; quaternions have a length of 1 within 1 %.
/// @throws Error, one sentence: the type, the JSON path, what was found, what was expected.
ClientMessage parse_client_message(std::string_view text, const TextLimits& limits = {});
ServerMessage parse_server_message(std::string_view text, const TextLimits& limits = kServerText);

/// One line of JSON without a newline. Numbers that are not finite cannot be written.
/// @throws std::logic_error for one.
std::string to_text(const ClientMessage& message);
std::string to_text(const ServerMessage& message);
std::string to_text(const Status& reply);
std::string to_text(const UploadReply& reply);
std::string to_text(const ErrorReply& reply);
std::string to_text(const LogList& reply);

/// The member "type" of a message.
std::string_view type_of(const ClientMessage& message);
std::string_view type_of(const ServerMessage& message);

/// The text of schema/wire.schema.json.
std::string_view schema_text();

/// Whether a JSON text is sound by an entry of the schema's $defs.
/// @throws Error as parse_client_message, or where there is no such entry.
void require_schema(std::string_view text, std::string_view definition,
                    const TextLimits& limits = kServerText);

}  // namespace eigengrasp::wire
