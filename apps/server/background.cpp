// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/background.hpp"

namespace eigengrasp::server {

Background::~Background() {
  wait_for_all();
}

void Background::run(std::function<void()> work) {
  const std::lock_guard lock(mutex_);
  for (auto it = runners_.begin(); it != runners_.end();) {
    if (!it->done->load()) {
      ++it;
      continue;
    }
    it->thread.join();
    it = runners_.erase(it);
  }
  auto done = std::make_shared<std::atomic<bool>>(false);
  runners_.push_back({std::thread([work = std::move(work), done]() mutable {
                        work();
                        work = nullptr;
                        done->store(true);
                      }),
                      done});
}

void Background::wait_for_all() {
  std::list<Runner> runners;
  {
    const std::lock_guard lock(mutex_);
    runners.swap(runners_);
  }
  for (Runner& runner : runners) runner.thread.join();
}

}  // namespace eigengrasp::server
