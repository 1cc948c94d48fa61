// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/outgoing_queue.hpp"

#include <algorithm>

namespace eigengrasp::server {

bool OutgoingQueue::push(std::string text, Kind kind) {
  if (kind != Kind::lasting) {
    const auto waiting =
        std::find_if(messages_.begin(), messages_.end(), [&](const Message& m) { return m.kind == kind; });
    if (waiting != messages_.end()) {
      bytes_ -= static_cast<std::int64_t>(waiting->text.size());
      messages_.erase(waiting);
    }
  }
  bytes_ += static_cast<std::int64_t>(text.size());
  messages_.push_back({std::move(text), kind});
  return bytes_ <= max_bytes_;
}

std::optional<OutgoingQueue::Message> OutgoingQueue::pop(bool views) {
  const auto first = std::find_if(messages_.begin(), messages_.end(),
                                  [&](const Message& m) { return views || m.kind != Kind::view; });
  if (first == messages_.end()) return {};
  Message message = std::move(*first);
  messages_.erase(first);
  bytes_ -= static_cast<std::int64_t>(message.text.size());
  return message;
}

}  // namespace eigengrasp::server
