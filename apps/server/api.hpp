// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>

#include "server/http_types.hpp"
#include "server/services.hpp"
#include "server/static_files.hpp"

namespace eigengrasp::server {

/// Answers HTTP requests; docs/wire-protocol.md lists them. From any thread.
class Api {
 public:
  Api(Services& services, StaticFiles files) : services_(services), files_(std::move(files)) {}

  /// Refuses foreign hosts and origins, missing tokens and methods that are not served. Does not block.
  std::optional<HttpReply> admit(const HttpRequest& request) const;
  bool takes_body(const HttpRequest& request) const;
  HttpReply answer(const HttpRequest& request);

 private:
  bool has_token(const HttpRequest& request) const;
  HttpReply status(const HttpRequest& request) const;
  HttpReply upload(const HttpRequest& request, bool hand);
  HttpReply logs() const;
  HttpReply log(const std::string& name) const;

  Services& services_;
  StaticFiles files_;
};

}  // namespace eigengrasp::server
