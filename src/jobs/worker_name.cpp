// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/worker_name.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

namespace eigengrasp {

namespace {

/// Slurm's name of the node where there is one: several may be on one machine.
std::string host_name() {
  if (const char* node = std::getenv("SLURMD_NODENAME"); node != nullptr && *node != '\0') return node;
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "localhost";
}

/// When a process began, in ticks since the machine did; none where there is no such process.
std::optional<std::string> start_of(const std::string& pid) {
  std::ifstream stat("/proc/" + pid + "/stat");
  std::string text;
  if (!std::getline(stat, text)) return std::nullopt;
  const std::size_t end_of_name = text.rfind(')');
  if (end_of_name == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(end_of_name + 1));
  std::string field;
  constexpr int start_time = 20;  // the 22nd field, the name being the second
  for (int i = 0; i < start_time; ++i) fields >> field;
  return field;
}

}  // namespace

std::string worker_name(int thread) {
  const std::string pid = std::to_string(getpid());
  return fmt::format("{}:{}.{}/{}", host_name(), pid, start_of(pid).value_or("0"), thread);
}

std::string host_of_worker(const std::string& worker) {
  return worker.substr(0, worker.rfind(':'));
}

bool has_ended_here(const std::string& worker) {
  const std::size_t colon = worker.rfind(':');
  const std::size_t dot = worker.find('.', colon == std::string::npos ? 0 : colon);
  const std::size_t slash = worker.find('/', dot == std::string::npos ? 0 : dot);
  if (colon == std::string::npos || dot == std::string::npos || slash == std::string::npos) return false;
  if (worker.substr(0, colon) != host_name()) return false;
  const std::string pid = worker.substr(colon + 1, dot - colon - 1);
  if (pid.empty() || pid.find_first_not_of("0123456789") != std::string::npos) return false;
  return start_of(pid) != worker.substr(dot + 1, slash - dot - 1);
}

}  // namespace eigengrasp
