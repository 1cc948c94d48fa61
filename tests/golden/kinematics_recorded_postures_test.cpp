// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Provenance: 1,911 human grasps of ContactPose, fitted to a hand of 20 joints; the shares of variance were
// computed by the keepers of the data set with other software.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "eigengrasp/kinematics/eigengrasp_space.hpp"
#include "support/test_data.hpp"

namespace eigengrasp {
namespace {

/// The columns behind id, valid and fit_error of the rows that are marked valid.
Eigen::MatrixXd read_valid_postures(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    if (row.at(1) == 1.0) rows.emplace_back(row.begin() + 3, row.end());
  }
  Eigen::MatrixXd postures(static_cast<Eigen::Index>(rows.size()),
                           static_cast<Eigen::Index>(rows.at(0).size()));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      postures(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r][c];
  return postures;
}

TEST(RecordedPostures, PcaVsPublishedVariance) {
  const auto file = testing::test_data("hand_postures/contactpose_shadow20.csv");
  EIGENGRASP_REQUIRE_DATA(file);
  const Eigen::MatrixXd postures = read_valid_postures(file);
  ASSERT_EQ(postures.cols(), 20);
  const PostureComponents pca = compute_posture_components(postures);
  EXPECT_NEAR(100.0 * pca.explained(1), 40.5, 0.05);
  EXPECT_NEAR(100.0 * pca.explained(2), 60.5, 0.05);
  EXPECT_NEAR(100.0 * pca.explained(6), 84.2, 0.05);
  EXPECT_NEAR(pca.explained(20), 1.0, 1e-12);
}

}  // namespace
}  // namespace eigengrasp
