// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/postgres_address.hpp"

#include "database/transient_error.hpp"

namespace eigengrasp {

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string without_password(const std::string& url) {
  std::string out = url.substr(0, url.find('?'));
  const auto begin = out.find("://");
  const auto end = out.rfind('@');
  if (begin == std::string::npos || end == std::string::npos) return out;
  const auto colon = out.find(':', begin + 3);
  if (colon < end) out.erase(colon, end - colon);
  return out;
}

void complain_of_connection(const std::string& place, const std::string& message, bool may_come) {
  const auto says = [&](const char* part) { return message.find(part) != std::string::npos; };
  if (says("password authentication failed") || says("no password supplied"))
    fail(
        "{}: the server refused the user's name or password; write postgresql://USER:PASSWORD@HOST/DATABASE, "
        "or set PGPASSWORD",
        place);
  if (says("database \"") && says("does not exist"))
    fail("{}: the server has no such database; make it with 'createdb NAME'", place);
  if (says("role \"") && says("does not exist")) fail("{}: the server has no such user", place);
  const bool for_now = says("starting up") || says("shutting down") || says("recovery mode") ||
                       says("too many clients") || says("connection slots");
  if (for_now) throw TransientError(fmt::format("{}: {}", place, first_line(message)), false);
  if (may_come) throw TransientError(fmt::format("{}: the server does not answer", place), false);
  if (says("Connection refused") || says("No such file or directory"))
    fail("{}: no PostgreSQL server answers there; is it running, and are host and port right?", place);
  fail("{}: {}", place, first_line(message));
}

}  // namespace eigengrasp
