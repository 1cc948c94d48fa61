// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "server/client.hpp"

namespace eigengrasp::server {

/// Messages that wait for a client. A newer view, progress or milestone takes the place of one that waits, so
/// that what waits is bounded by what cannot be replaced; that in turn is bounded by bytes.
class OutgoingQueue {
 public:
  struct Message {
    std::string text;
    Kind kind;
  };

  explicit OutgoingQueue(std::int64_t max_bytes) : max_bytes_(max_bytes) {}

  /// False where the client is too far behind: it is to be dropped.
  bool push(std::string text, Kind kind);
  bool empty() const { return messages_.empty(); }
  /// Takes the first; none where there is none. @param views whether a view may be taken; else it is passed
  /// over
  std::optional<Message> pop(bool views = true);
  std::int64_t bytes() const { return bytes_; }
  std::size_t size() const { return messages_.size(); }

 private:
  std::int64_t max_bytes_;
  std::int64_t bytes_ = 0;
  std::deque<Message> messages_;
};

}  // namespace eigengrasp::server
