// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Session logs come back as they were written, and what an operator did can be played into a planner again.
// Messages of grasps and views agree with the forward kinematics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/wire/message_makers.hpp"
#include "eigengrasp/wire/session_replay.hpp"
#include "eigengrasp/wire/wire_text.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp::wire {
namespace {

using ::testing::HasSubstr;

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / ("eigengrasp_" + name);
}

Wrist wrist_at(double time, double x) {
  Wrist wrist;
  wrist.time = time;
  wrist.pose = {x, 0, 0, 1, 0, 0, 0};
  return wrist;
}

OnlineStart start_of(const std::string& hand) {
  OnlineStart start;
  start.hand = hand;
  start.object = "block";
  return start;
}

TEST(SessionLog, HoldsWhatCameInAndWentOutButNoToken) {
  const auto file = scratch("log.jsonl");
  Hello hello;
  hello.token = "very secret";
  const std::string out = to_text(ServerMessage(OnlineStopped{"s1"}));
  {
    SessionLogWriter writer(file);
    writer.write_in(ClientMessage(hello));
    writer.write_in(ClientMessage(wrist_at(1.5, 0.25)));
    writer.write_out(out);
  }
  EXPECT_THAT(read_text_file(file), ::testing::Not(HasSubstr("secret")));
  const auto lines = read_session_log(file);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_FALSE(std::get<Hello>(std::get<ClientMessage>(lines[0].message)).token);
  EXPECT_EQ(std::get<Wrist>(std::get<ClientMessage>(lines[1].message)).pose[0], 0.25);
  EXPECT_EQ(to_text(std::get<ServerMessage>(lines[2].message)), out);
  EXPECT_LE(lines[0].t, lines[1].t);
  EXPECT_LE(lines[1].t, lines[2].t);
}

TEST(SessionLog, ALastLineThatWasCutOffIsLeftOut) {
  const auto file = scratch("cut.jsonl");
  std::ofstream(file) << R"({"t":0.5,"in":{"type":"online.stop"}})"
                      << "\n"
                      << R"({"t":0.6,"in":{"type":)";
  EXPECT_EQ(read_session_log(file).size(), 1u);
}

TEST(SessionLog, ABadLineIsNamedByFileAndNumber) {
  const auto file = scratch("bad.jsonl");
  std::ofstream(file) << R"({"t":0,"in":{"type":"online.stop"}})"
                      << "\n"
                      << R"({"t":1,"in":{"type":"x"}})"
                      << "\n";
  try {
    read_session_log(file);
    FAIL() << "was read";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("bad.jsonl:2: "));
    EXPECT_THAT(e.what(), HasSubstr("in.type"));
  }
}

TEST(SessionLog, NothingIsWrittenBeyondTheLimit) {
  const auto file = scratch("full.jsonl");
  {
    SessionLogWriter writer(file, 150);
    for (int i = 0; i < 100; ++i) writer.write_in(ClientMessage(OnlineStop{}));
  }
  EXPECT_LE(std::filesystem::file_size(file), 150u);
  EXPECT_GE(read_session_log(file).size(), 1u);
}

TEST(SessionLog, AFolderThatIsNotThereIsASentence) {
  EXPECT_THROW(SessionLogWriter(scratch("none") / "x" / "log.jsonl"), Error);
}

TEST(SessionReplay, TasksGoFromStartToStartOrStop) {
  const std::vector<LogLine> log = {
      {0.0, ClientMessage(wrist_at(0, 0))},      {1.0, ClientMessage(start_of("a"))},
      {1.5, ServerMessage(OnlineStopped{"s1"})}, {2.0, ClientMessage(wrist_at(7, 0.1))},
      {2.5, ClientMessage(Command{})},           {3.0, ClientMessage(OnlineStop{})},
      {3.5, ClientMessage(wrist_at(8, 0.2))},    {4.0, ClientMessage(start_of("b"))},
      {4.5, ClientMessage(start_of("c"))},       {5.0, ClientMessage(Targets{})}};
  const auto tasks = recorded_tasks(log);
  ASSERT_EQ(tasks.size(), 3u);
  EXPECT_EQ(tasks[0].start.hand, "a");
  ASSERT_EQ(tasks[0].input.size(), 2u);
  EXPECT_EQ(tasks[0].input[0].t, 0.0);
  EXPECT_EQ(tasks[0].input[1].t, 0.5);
  EXPECT_TRUE(tasks[1].input.empty());
  EXPECT_EQ(tasks[2].input.size(), 1u);
}

TEST(SessionReplay, ThePlannerSeesEveryWristInItsOrder) {
  auto hand = testing::two_finger_hand();
  set_collision_pairs(*hand, {});
  const Scene scene = testing::scene_of(hand, testing::solid(testing::box_mesh({0.03, 0.035, 0.04})));
  RecordedTask task{start_of("two"), {}, {}};
  for (int i = 0; i < 5; ++i)
    task.input.push_back({0.01 * i, ClientMessage(wrist_at(0.1 * i, 0.5 - 0.01 * i))});
  task.input.push_back({0.05, ClientMessage(Command{OperatorCommand::close, {}})});
  OnlinePlanner planner(scene, online_options(task.start));
  std::vector<double> seen;
  int closed = 0;
  replay(task, planner,
         {.speed = 0.0,
          .seen = [&](const OnlineView& view) { seen.push_back(view.wrist.time); },
          .closed = [&](const std::optional<Grasp>&) { ++closed; }});
  EXPECT_EQ(closed, 1);
  EXPECT_EQ(seen, (std::vector<double>{0.0, 0.1, 0.2, 0.1 * 3, 0.4, 0.4}));
}

TEST(MessageMakers, AClosingGoesFromPregraspToGraspAsTheKinematicsSay) {
  auto hand = testing::two_finger_hand();
  Grasp grasp;
  grasp.X_OH_pregrasp = make_pose(Eigen::Quaterniond(0.9, 0.1, 0.2, 0.3), {0.1, 0.2, 0.3});
  grasp.X_OH = make_pose(Eigen::Quaterniond(0.8, 0.2, 0.2, 0.3), {0.1, 0.2, 0.25});
  const VecX open = joint_values(*hand, hand->dof_min());
  const VecX closed = joint_values(*hand, hand->dof_max());
  for (int j = 0; j < hand->n_joints(); ++j) {
    const std::string& name = hand->joints[static_cast<std::size_t>(j)].name;
    grasp.pregrasp_joints.emplace_back(name, open[j]);
    grasp.grasp_joints.emplace_back(name, closed[j]);
  }
  const GraspShape shape = grasp_shape(*hand, grasp, 5);
  ASSERT_EQ(shape.closing.size(), 5u);
  EXPECT_EQ(shape.closing.front(), posture_poses(*hand, hand->dof_min(), grasp.X_OH_pregrasp));
  EXPECT_EQ(shape.closing.back(), posture_poses(*hand, hand->dof_max(), grasp.X_OH));
  std::vector<Pose> X_OL;
  compute_link_poses(*hand, closed, grasp.X_OH, X_OL);
  ASSERT_EQ(shape.closing.back().size(), X_OL.size());
  for (std::size_t i = 0; i < X_OL.size(); ++i)
    EXPECT_TRUE(to_pose(shape.closing.back()[i]).isApprox(X_OL[i], 5e-6)) << "link " << i;
  EXPECT_NO_THROW(require_schema(to_text(ServerMessage(Closed{shape, ""})), "Closed"));
}

TEST(MessageMakers, AViewIsSoundByTheSchemaEvenBeforeTheFirstWrist) {
  auto hand = testing::two_finger_hand();
  const View view = view_message(*hand, OnlineView{});
  EXPECT_FALSE(view.wrist);
  EXPECT_EQ(view.link_poses.size(), static_cast<std::size_t>(hand->n_links()));
  EXPECT_NO_THROW(require_schema(to_text(ServerMessage(view)), "View"));
}

}  // namespace
}  // namespace eigengrasp::wire
