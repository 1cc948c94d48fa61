// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

FolderLock::FolderLock(const std::filesystem::path& folder, bool writing, double seconds,
                       const std::string& place) {
  const auto path = folder / ".lock";
  file_ = ::open(path.c_str(), writing ? O_RDWR | O_CREAT | O_CLOEXEC : O_RDONLY | O_CLOEXEC, 0666);
  if (file_ < 0 && !writing) return;  // never written here
  if (file_ < 0) fail("{}: the folder cannot be written to ({})", place, std::strerror(errno));
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (::flock(file_, (writing ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
    if (Clock::now() >= end) {
      ::close(file_);
      fail("{}: is in use by another program (waited {} s); a text store has one writer at a time", place,
           seconds);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace eigengrasp
