// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Moves the wrist of an interactive session from another program, by datagrams (docs/trackers.md). Needs
// nothing but POSIX sockets:  g++ -std=c++20 tracker_sender.cpp -o tracker_sender && ./tracker_sender 8081
// Start `eigengrasp serve --udp 8081`, open the app's page Interactive and start a session first. Put your
// device in place of read_tracker().
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

/// Pose of the hand base in the object frame at time t [s]: x, y, z [m], quaternion w, x, y, z. Here: from 40
/// cm beside the object towards it and back again, once in 8 s, with a slight turn about z.
std::array<double, 7> read_tracker(double t) {
  const double distance = 0.15 + 0.25 * std::abs(std::fmod(t / 4.0, 2.0) - 1.0);
  const double turn = 0.2 * std::sin(t);
  return {distance, 0.0, 0.0, std::cos(turn / 2), 0.0, 0.0, std::sin(turn / 2)};
}

std::string wrist_message(double t, const std::array<double, 7>& pose) {
  char text[512];
  const int length = std::snprintf(
      text, sizeof text, "{\"type\":\"wrist\",\"time\":%.6f,\"pose\":[%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g]}\n",
      t, pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], pose[6]);
  return {text, static_cast<std::size_t>(length)};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || std::atoi(argv[1]) <= 0) {
    std::fprintf(stderr, "usage: tracker_sender UDP_PORT [POSES_A_SECOND [SECONDS]]\n");
    return 2;
  }
  const double rate = argc > 2 ? std::atof(argv[2]) : 100.0;
  const double seconds = argc > 3 ? std::atof(argv[3]) : 1e9;
  const int out = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in server{};
  server.sin_family = AF_INET;
  server.sin_port = htons(static_cast<std::uint16_t>(std::atoi(argv[1])));
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (out < 0 || !(rate > 0.0)) {
    std::fprintf(stderr, "tracker_sender: no socket, or a rate that is not above 0\n");
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  long n = 0;
  for (; static_cast<double>(n) < seconds * rate; ++n) {
    std::this_thread::sleep_until(start + std::chrono::duration<double>(static_cast<double>(n) / rate));
    const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string text = wrist_message(t, read_tracker(t));
    ::sendto(out, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&server), sizeof server);
  }
  ::close(out);
  std::printf("%ld poses sent\n", n);
  return 0;
}
