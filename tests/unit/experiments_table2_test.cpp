// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Table II: counts made up by hand, what becomes of them in the targets, the page and the JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/experiments/performance.hpp"
#include "eigengrasp/experiments/table2_report.hpp"

namespace eigengrasp {
namespace {

const ExperimentRecord record{{"Some Processor", 2, 8e9, "avx2"}, "1.2.3", "eigengrasp reproduce table2"};

Table2Run make_run(std::uint64_t seed, int closed, int tested) {
  Table2Run run;
  run.seed = seed;
  run.candidates.form_closed = closed;
  run.candidates.tested = tested;
  run.candidates.not_closed = tested - closed;
  run.timings = {0.5, 0.25, 0.125, 0.875, 0.25};
  return run;
}

/// Every cell of a part has two runs: with one less and one more than the count given for it.
Table2 make_table(const std::array<int, 4>& closed) {
  Table2Options options;
  options.seeds = 2;
  Table2 table{options, PaperScenes({}, {}, {}), {}, false};
  int i = 0;
  for (const SearchKind search : {SearchKind::paper, SearchKind::staged})
    for (const FrictionCase friction : {FrictionCase::materials, FrictionCase::one}) {
      const int count = closed.at(static_cast<std::size_t>(i++));
      Table2Part part{search, friction, {}};
      for (const PaperHand hand : kPaperHands)
        for (const PaperObject object : kPaperObjects)
          part.cells.push_back({hand, object, {make_run(1, count - 1, 20), make_run(2, count + 1, 20)}});
      table.parts.push_back(std::move(part));
    }
  return table;
}

TEST(Table2, TargetsAreJudgedByTheMeansAndTheCells) {
  const auto met = check_targets(make_table({5, 8, 17, 15}));
  ASSERT_EQ(met.size(), 5U);
  for (const Table2Target& target : met) EXPECT_TRUE(target.met) << target.text << ": " << target.measured;
  const auto missed = check_targets(make_table({5, 7, 8, 13}));
  EXPECT_FALSE(missed[0].met);  // 7 < 8
  EXPECT_FALSE(missed[1].met);  // 13 < 14
  // Above 13 in the paper: Robonaut on glass and flask 14.4, human on ashtray 14.6 and flask 13.4.
  EXPECT_EQ(
      missed[2].measured,
      "Robonaut on glass 13.0 < 14.4; Robonaut on flask 13.0 < 14.4; human on ashtray 13.0 < 14.6; human "
      "on flask 13.0 < 13.4");
  EXPECT_FALSE(missed[3].met);  // 8 < 11
  EXPECT_FALSE(missed[4].met);  // GraspIt! reached up to 16.3
}

TEST(Table2, TrialsAreNotJudged) {
  Table2 few_cells = make_table({20, 20, 19, 19});
  few_cells.parts[3].cells.pop_back();
  EXPECT_TRUE(check_targets(few_cells).empty());
  Table2 few_states = make_table({20, 20, 19, 19});
  few_states.options.iterations = 3000;
  EXPECT_TRUE(check_targets(few_states).empty());
}

TEST(Table2, PageHasEveryCellBesideItsReferences) {
  Table2 table = make_table({5, 8, 12, 15});
  table.parts[0].cells[2].runs[0].candidates.tested = 19;  // Barrett on glass
  const std::string page = table2_markdown(table, record, {{"table2/figure2.png", "Fig. 2", {}}});
  EXPECT_NE(page.find("| **Barrett** | **5.0 ± 1.4** | **5.0 ± 1.4** | **5.0 ± 1.4 of 19.5** |"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("| paper | 2.8 | 1.0 | 5.8 | 3.4 | 1.4 | 4.0 | 3.1 |"), std::string::npos);
  EXPECT_NE(page.find("| GraspIt! | 16.3 | 9.3 | 7.3 | 13.7 | 7.7 | 2.0 | 9.4 |"), std::string::npos);
  EXPECT_NE(page.find("Mean over the 24 cells: **12.0**; paper 6.8; GraspIt! 5.7."), std::string::npos);
  EXPECT_NE(page.find("0.500 | 0.250 | 0.125 | 0.875"), std::string::npos);
  EXPECT_NE(page.find("eigengrasp 1.2.3; Some Processor, 2 threads, 8 GB, avx2."), std::string::npos);
  EXPECT_NE(page.find("![Fig. 2](table2/figure2.png)"), std::string::npos);
  EXPECT_NE(page.find("the seeds 1 to 2"), std::string::npos);
  EXPECT_EQ(page.back(), '\n');
}

TEST(Table2, JsonHoldsEveryRun) {
  const auto json = nlohmann::json::parse(table2_json(make_table({5, 8, 12, 15}), record));
  EXPECT_EQ(json["format"], "eigengrasp-table2");
  EXPECT_EQ(json["command"], record.command);
  EXPECT_EQ(json["machine"]["instruction_set"], "avx2");
  EXPECT_EQ(json["targets"].size(), 5U);
  ASSERT_EQ(json["parts"].size(), 4U);
  EXPECT_EQ(json["parts"][3]["search"], "staged");
  EXPECT_EQ(json["parts"][3]["friction"], "one");
  EXPECT_EQ(json["parts"][3]["form_closed_mean"], 15.0);
  ASSERT_EQ(json["parts"][3]["cells"].size(), 24U);
  const auto& cell = json["parts"][3]["cells"][20];
  EXPECT_EQ(cell["hand"], "human");
  EXPECT_EQ(cell["object"], "glass");
  EXPECT_EQ(cell["paper"], 11.2);
  EXPECT_EQ(cell["graspit"], 7.3);
  EXPECT_NEAR(cell["form_closed_standard_deviation"].get<double>(), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(cell["runs"][1]["seed"], 2);
  EXPECT_EQ(cell["runs"][1]["form_closed"], 16);
  EXPECT_EQ(cell["runs"][1]["seconds"]["search"], 0.25);
}

TEST(Table2, OptionsOutOfBoundsAreNamed) {
  Table2Options options;
  EXPECT_TRUE(options.validate().empty());
  options.seeds = 0;
  options.iterations = 0;
  options.threads = -1;
  options.hands.clear();
  EXPECT_EQ(options.validate().size(), 4U);
  EXPECT_THROW(run_table2(options), Error);
}

PerformanceReport make_report() {
  ScenePerformance scene;
  scene.hand = "human";
  scene.object = "glass";
  scene.paper_hand = PaperHand::human;
  scene.candidates = 20;
  scene.closed_on_the_way = 140;
  scene.legal_share = 0.25;
  scene.judged_per_second = 2.1e6;
  scene.steps = {150e-6, 40e-6, 5e-6, 20e-6};
  scene.by_threads = {{1, 0.3, 0.25, 0.02, 0.08, 0.09, 2.5e6, 4762.0},
                      {2, 0.2, 0.15, 0.01, 0.05, 0.06, 4.875e6, 9000.0}};
  scene.peak_memory = 150'000'000;
  return {record, {}, {0.1e-3, 0.01e-3}, {scene}};
}

// 0.21 ms times 2.1 million states are 441 seconds; 50 ms over 0.21 ms are 238.
TEST(Performance, PageComparesWithGraspit) {
  const std::string page = performance_markdown(make_report());
  EXPECT_NE(
      page.find(
          "| human on glass: one state, legality and energy | 0.21 ms | 0.5 us | 0.48 us | 441 x | met |"),
      std::string::npos)
      << page;
  EXPECT_NE(page.find("| 50 ms | 0.25 ms | 0.21 ms | 238 x | met |"), std::string::npos);
  EXPECT_NE(page.find("| 1.9 x | 1.95 x |"), std::string::npos);
  EXPECT_NE(page.find("2.50 M | 25 % | 4762 | 150 | 40 | 5.0 | 20.0 | 80 | 90 | 300 | 250 | 20 | 150 |"),
            std::string::npos);
  EXPECT_NE(page.find("best 20 closed and rated (the paper's search) | 20-50 s | 0.1 s | 0.090 s |"),
            std::string::npos);
  EXPECT_NE(page.find("140 closed on the way, best 20 kept | 20-50 s | 0.1 s | 0.080 s |"),
            std::string::npos);
  EXPECT_EQ(page.find("not met"), std::string::npos);
  PerformanceReport slow = make_report();
  slow.scenes[0].judged_per_second = 1.9e6;
  EXPECT_NE(performance_markdown(slow).find("| 0.53 us | 399 x | **not met** |"), std::string::npos);
}

TEST(Performance, JsonHoldsBothThreadCounts) {
  const auto json = nlohmann::json::parse(performance_json(make_report()));
  EXPECT_EQ(json["format"], "eigengrasp-bench");
  const auto& scene = json["scenes"][0];
  EXPECT_NEAR(scene["microseconds"]["close"].get<double>(), 150.0, 1e-9);
  EXPECT_EQ(scene["threads"][1]["threads"], 2);
  EXPECT_EQ(scene["threads"][1]["states_per_second"], 4.875e6);
}

}  // namespace
}  // namespace eigengrasp
