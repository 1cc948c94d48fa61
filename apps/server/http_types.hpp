// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <string>
#include <vector>

namespace eigengrasp::server {

/// An HTTP request, taken apart; names of a query and paths are decoded.
struct HttpRequest {
  std::string method;  ///< GET for HEAD as well
  std::string path;
  std::map<std::string, std::string> query;
  std::string host;
  std::string origin;         ///< empty where there is none
  std::string authorization;  ///< empty where there is none
  std::string body;
  bool websocket = false;  ///< asks for a WebSocket
};

struct HttpReply {
  int status = 200;
  std::string content_type = "application/json";
  std::string body;
  std::string file_name;  ///< a browser saves it under; empty: it is shown
};

/// An answer of code 400 or more, its body as the schema's ErrorReply.
HttpReply refusal(int status, const std::string& sentence);

}  // namespace eigengrasp::server
