// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Messages of the wire: written and read again they are the same; what is not sound is refused with a
// sentence that names place, value and expectation; defaults are those of the planners.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/wire/message_makers.hpp"
#include "eigengrasp/wire/wire_text.hpp"

namespace eigengrasp::wire {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string sentence_of(const std::string& text) {
  try {
    parse_client_message(text);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(WireMessages, AWristKeepsEveryBitOfItsNumbers) {
  Wrist wrist;
  wrist.time = 0.1 + 0.2;
  wrist.pose = {1.0 / 3.0, -1e-17, 123.456789012345678, 0.6, 0.0, 0.8, -0.0};
  wrist.session = "s1";
  const ClientMessage read = parse_client_message(to_text(ClientMessage(wrist)));
  const auto& back = std::get<Wrist>(read);
  EXPECT_EQ(back.time, wrist.time);
  EXPECT_EQ(back.pose, wrist.pose);
  EXPECT_EQ(back.session, wrist.session);
}

TEST(WireMessages, WhatHasNoValueIsLeftOut) {
  EXPECT_EQ(to_text(ClientMessage(Hello{})), R"({"type":"hello","protocol":1,"role":"app"})");
  EXPECT_EQ(to_text(ServerMessage(Closed{{}, "nothing"})), R"({"type":"closed","message":"nothing"})");
}

TEST(WireMessages, AbsentOptionsAreThePlannersDefaults) {
  const auto plan =
      std::get<PlanStart>(parse_client_message(R"({"type":"plan.start","hand":"h","object":"o"})"));
  const PlanOptions planned = plan_options(plan);
  const PlanOptions plain;
  EXPECT_EQ(planned.iterations, plain.iterations);
  EXPECT_EQ(planned.grasps, plain.grasps);
  EXPECT_EQ(planned.seed, plain.seed);
  EXPECT_EQ(planned.search, plain.search);
  EXPECT_EQ(planned.energy, plain.energy);
  EXPECT_EQ(planned.amplitudes, plain.amplitudes);
  const auto online =
      std::get<OnlineStart>(parse_client_message(R"({"type":"online.start","hand":"h","object":"o"})"));
  const OnlineOptions ours = online_options(online);
  const OnlineOptions theirs;
  EXPECT_EQ(ours.seed, theirs.seed);
  EXPECT_EQ(ours.amplitudes, theirs.amplitudes);
  EXPECT_EQ(ours.cone_half_angle, theirs.cone_half_angle);
  EXPECT_EQ(ours.look_ahead, theirs.look_ahead);
  EXPECT_EQ(ours.step_back, theirs.step_back);
  EXPECT_EQ(ours.epsilon_min, theirs.epsilon_min);
  EXPECT_EQ(ours.preshape_begins, theirs.preshape_begins);
}

TEST(WireMessages, ASentenceNamesPlaceValueAndExpectation) {
  EXPECT_THAT(sentence_of(R"({"type":"wrist","time":1,"pose":[0,0,"a",1,0,0,0]})"),
              AllOf(HasSubstr("wrist: pose[2]"), HasSubstr("\"a\""), HasSubstr("a number from -1000")));
  EXPECT_THAT(sentence_of(R"({"type":"wrist","time":1})"), AllOf(HasSubstr("pose"), HasSubstr("is missing")));
  EXPECT_THAT(sentence_of(R"({"type":"wrist","time":1,"pose":[0,0,0,0.5,0,0,0]})"),
              AllOf(HasSubstr("quaternion"), HasSubstr("0.5"), HasSubstr("expected length 1")));
  EXPECT_THAT(sentence_of(R"({"type":"plan.start","hand":"h","object":"o","options":{"grasps":0}})"),
              AllOf(HasSubstr("options.grasps"), HasSubstr("found 0"), HasSubstr("from 1 to 100")));
  EXPECT_THAT(sentence_of(R"({"type":"jump"})"), AllOf(HasSubstr("jump"), HasSubstr("\"wrist\"")));
  EXPECT_THAT(sentence_of(R"({"type":"plan.stop","now":true})"), HasSubstr("\"now\""));
  EXPECT_THAT(sentence_of("[" + std::string(40, '[')), HasSubstr("deep"));
  EXPECT_THAT(sentence_of(std::string(70000, ' ')), AllOf(HasSubstr("70000 bytes"), HasSubstr("65536")));
}

TEST(WireMessages, ALongForeignTextIsCutWhereACharacterEnds) {
  std::string umlauts;
  for (int i = 0; i < 200; ++i) umlauts += "ä";
  const std::string sentence = sentence_of("{\"type\":\"" + umlauts + "\"}");
  EXPECT_LT(sentence.size(), 600u);
  ErrorMessage error{ErrorCode::bad_message, sentence, {}};
  EXPECT_THAT(to_text(ServerMessage(error)),
              ::testing::Not(HasSubstr("\xEF\xBF\xBD")));  // no broken character
}

TEST(WireMessages, NumbersThatAreNotFiniteAreNotWritten) {
  Wrist wrist;
  wrist.time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(to_text(ClientMessage(wrist)), std::logic_error);
}

TEST(WireMessages, PosesComeBackAsTheyWent) {
  const Pose X = make_pose(Eigen::Quaterniond(0.5, -0.5, 0.1, 0.7), {0.1, 0.2, -0.3});
  EXPECT_TRUE(to_pose(pose_numbers(X)).isApprox(X, 1e-14));
  EXPECT_TRUE(to_pose(drawn_pose(X)).isApprox(X, 2e-6));
  EXPECT_EQ(drawn_pose(make_pose(Eigen::Quaterniond::Identity(), {1e9, 0, 0}))[0], 1000.0);
}

TEST(WireMessages, TheSchemaIsPartOfTheProgram) {
  EXPECT_NO_THROW(require_schema(R"({"error":"x"})", "ErrorReply"));
  EXPECT_THROW(require_schema(R"({"error":7})", "ErrorReply"), Error);
  EXPECT_THROW(require_schema("{}", "NoSuchEntry"), Error);
}

}  // namespace
}  // namespace eigengrasp::wire
