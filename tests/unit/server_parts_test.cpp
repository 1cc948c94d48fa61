// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Parts of the server that need no socket: who may talk to it, paths, queues of slow clients, rates, files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eigengrasp/core/error.hpp"
#include "server/counter.hpp"
#include "server/outgoing_queue.hpp"
#include "server/rate_limit.hpp"
#include "server/server_options.hpp"
#include "server/static_files.hpp"
#include "server/web_address.hpp"

namespace eigengrasp::server {
namespace {

TEST(WebAddress, LoopbackIsThisMachineAlone) {
  for (const char* host : {"localhost", "LocalHost", "127.0.0.1", "127.1.2.3", "::1"})
    EXPECT_TRUE(is_loopback(host)) << host;
  for (const char* host : {"", "0.0.0.0", "10.0.0.1", "localhost.evil.example", "127.0.0.1.evil.example",
                           "127.evil", "127.0.0", "::2", "example", "1127.0.0.1", "127.0.0.1 "})
    EXPECT_FALSE(is_loopback(host)) << host;
}

TEST(WebAddress, OriginsAreTheServersOwnOrLoopback) {
  EXPECT_TRUE(is_own_origin("", "127.0.0.1:8080"));
  EXPECT_TRUE(is_own_origin("http://localhost:5173", "127.0.0.1:8080"));
  EXPECT_TRUE(is_own_origin("http://robot.lab:8080", "Robot.Lab:8080"));
  EXPECT_TRUE(is_own_origin("https://[::1]:80", "x"));
  for (const char* origin : {"http://evil.example", "null", "file://", "http://robot.lab:81",
                             "http://robot.lab", "http://localhost@evil.example", "http://localhost/",
                             "ftp://localhost", "http://", "http://[::1", "http://localhost:80?"})
    EXPECT_FALSE(is_own_origin(origin, "robot.lab:8080")) << origin;
}

TEST(WebAddress, AServerOnLoopbackAnswersToLoopbackNamesAlone) {
  EXPECT_TRUE(is_own_host("localhost:8080", "127.0.0.1"));
  EXPECT_FALSE(is_own_host("evil.example:8080", "127.0.0.1"));
  EXPECT_FALSE(is_own_host("", "127.0.0.1"));
  EXPECT_TRUE(is_own_host("robot.lab:8080", "0.0.0.0"));
}

TEST(WebAddress, TargetsAreTakenApartAndDecoded) {
  const auto target = parse_target("/api/objects?name=my%20part.stl&units=mm&flag&=x");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/api/objects");
  EXPECT_EQ(target->query.at("name"), "my part.stl");
  EXPECT_EQ(target->query.at("units"), "mm");
  EXPECT_EQ(target->query.at("flag"), "");
  EXPECT_EQ(parse_target("/a%2Fb")->path, "/a/b");
  EXPECT_EQ(parse_target("/?")->path, "/");
  for (const char* bad : {"", "x", "http://a/", "/%", "/%2", "/%zz", "/%00", "/a?x=%1"})
    EXPECT_FALSE(parse_target(bad)) << bad;
}

TEST(WebAddress, TokensAreEqualOrNot) {
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_TRUE(equal_in_constant_time("", ""));
  for (const auto& [a, b] :
       {std::pair{"abc", "abd"}, {"abc", "ab"}, {"ab", "abc"}, {"abcabc", "abc"}, {"", "a"}, {"a", ""}})
    EXPECT_FALSE(equal_in_constant_time(a, b)) << a << ' ' << b;
}

TEST(OutgoingQueue, ANewerViewTakesThePlaceOfOneThatWaits) {
  OutgoingQueue queue(1000);
  EXPECT_TRUE(queue.push("view 1", Kind::view));
  EXPECT_TRUE(queue.push("closed", Kind::lasting));
  EXPECT_TRUE(queue.push("progress 1", Kind::progress));
  EXPECT_TRUE(queue.push("view 2", Kind::view));
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_EQ(queue.pop()->text, "closed");
  EXPECT_EQ(queue.pop()->text, "progress 1");
  EXPECT_FALSE(queue.pop(false));
  EXPECT_EQ(queue.pop()->text, "view 2");
  EXPECT_TRUE(queue.empty());
  EXPECT_FALSE(queue.pop());
  EXPECT_EQ(queue.bytes(), 0);
}

TEST(OutgoingQueue, WhatCannotBeReplacedIsBounded) {
  OutgoingQueue queue(100);
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(queue.push(std::string(60, 'v'), Kind::view));
  EXPECT_TRUE(queue.push(std::string(40, 'x'), Kind::lasting));
  EXPECT_FALSE(queue.push("y", Kind::lasting));
}

TEST(RateLimit, LetsASecondsWorthPassAtOnceAndThenSoManyASecond) {
  const Clock::time_point start{};
  RateLimit limit(10.0, start);
  int passed = 0;
  for (int i = 0; i < 50; ++i) passed += limit.pass(start);
  EXPECT_EQ(passed, 10);
  for (int i = 1; i <= 100; ++i) passed += limit.pass(start + std::chrono::milliseconds(10 * i));
  EXPECT_NEAR(passed, 20, 1);
}

TEST(CounterTickets, AreNoMoreThanAllowedAndComeBack) {
  const auto counter = std::make_shared<Counter>();
  auto a = Counter::take(counter, 2);
  auto b = Counter::take(counter, 2);
  EXPECT_TRUE(a && b);
  EXPECT_FALSE(Counter::take(counter, 2));
  a.reset();
  EXPECT_TRUE(Counter::take(counter, 2));
}

TEST(StaticFiles, AreThoseOfTheFolderAndNoOthers) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "eigengrasp_app";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "app" / "assets");
  EXPECT_THROW(StaticFiles{folder / "app"}, Error);
  std::ofstream(folder / "app" / "index.html") << "index";
  std::ofstream(folder / "app" / "assets" / "a.js") << "script";
  std::ofstream(folder / "secret") << "secret";
  std::filesystem::create_symlink(folder / "secret", folder / "app" / "link");
  const StaticFiles files(folder / "app");
  EXPECT_EQ(files.reply("/").body, "index");
  EXPECT_EQ(files.reply("/assets/a.js").body, "script");
  for (const char* path :
       {"/link", "/../secret", "/assets", "/assets/", "", "//index.html", "/assets/../index.html"})
    EXPECT_EQ(files.reply(path).status, 404) << path;
  EXPECT_EQ(StaticFiles().reply("/").status, 200);
  EXPECT_NE(StaticFiles().reply("/").body.find("./run serve"), std::string::npos);
}

TEST(ServerOptions, AnAddressThatOthersReachNeedsAToken) {
  ServerOptions options;
  EXPECT_TRUE(options.validate().empty());
  options.bind = "0.0.0.0";
  EXPECT_EQ(options.validate().size(), 1u);
  options.token = "long enough";
  EXPECT_TRUE(options.validate().empty());
  options.token = "short";
  EXPECT_EQ(options.validate().size(), 1u);
}

}  // namespace
}  // namespace eigengrasp::server
