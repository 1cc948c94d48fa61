// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "eigengrasp/experiments/figure12.hpp"

namespace eigengrasp {
namespace {

Figure12Run run_of(std::vector<double> epsilons, double seconds) {
  const int n = static_cast<int>(epsilons.size());
  return {std::move(epsilons), n, 10 * n, seconds};
}

/// Two models, one hand.
Figure12 two_models() {
  Figure12Model a{
      "a", 0.5, {{run_of({0.4, 0.2}, 1.0), run_of({0.4, 0.2}, 1.0), run_of({0.2}, 2.0), run_of({0.3}, 3.0)}}};
  Figure12Model b{
      "b", 1.5, {{run_of({0.2}, 1.0), run_of({0.3, 0.1}, 1.0), run_of({}, 2.0), run_of({0.1}, 5.0)}}};
  return summarise_figure12({a, b}, {"human"});
}

TEST(Figure12, averages_the_nth_best_over_all_models) {
  const Figure12 result = two_models();
  EXPECT_EQ(result.models, 2);
  EXPECT_DOUBLE_EQ(result.prepare_seconds, 1.0);
  const auto& curves = result.curves.at(0);
  ASSERT_EQ(curves[0].epsilon.size(), static_cast<std::size_t>(kFigure12Ranks));
  EXPECT_DOUBLE_EQ(curves[0].epsilon[0], 0.3);
  EXPECT_DOUBLE_EQ(curves[0].epsilon[1], 0.1);  // a model with fewer counts 0
  EXPECT_DOUBLE_EQ(curves[1].epsilon[1], 0.15);
  EXPECT_EQ(curves[0].epsilon[2], 0.0);
  EXPECT_EQ(curves[2].without, 1);
  EXPECT_DOUBLE_EQ(curves[3].seconds, 4.0);
  EXPECT_DOUBLE_EQ(curves[1].candidates, 20.0);
}

TEST(Figure12, is_written_as_a_page_json_and_plots) {
  Figure12 result = two_models();
  result.neighbors = 5;
  result.left_out["c"] = "it has no descriptor";
  const ExperimentRecord record = make_record("eigengrasp reproduce figure12 --store STORE");
  const std::string page = figure12_markdown(result, record);
  for (const char* part : {"0.3000", "figure12/human.png", "1 models; the first is c: it has no descriptor"})
    EXPECT_NE(page.find(part), std::string::npos) << part << '\n' << page;
  const auto json = nlohmann::json::parse(figure12_json(result, record));
  EXPECT_EQ(json["models"], 2);
  EXPECT_EQ(json["hands"][0]["curves"][3]["method"], "planner");
  EXPECT_NE(figure12_svg(result, 0).find("<svg"), std::string::npos);
  EXPECT_GT(figure12_picture(result, 0).width, 100);
}

TEST(Figure12, options_that_are_out_of_bounds_are_named) {
  Figure12Options options;
  options.every = 0;
  const auto violations = options.validate();
  ASSERT_EQ(violations.size(), 2u);  // and no hands
  EXPECT_EQ(violations[1], "every is 0, expected 1 or more");
}

}  // namespace
}  // namespace eigengrasp
