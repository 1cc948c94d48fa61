// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/http_types.hpp"

#include "eigengrasp/wire/wire_text.hpp"

namespace eigengrasp::server {

HttpReply refusal(int status, const std::string& sentence) {
  return {status, "application/json", wire::to_text(wire::ErrorReply{sentence}), ""};
}

}  // namespace eigengrasp::server
