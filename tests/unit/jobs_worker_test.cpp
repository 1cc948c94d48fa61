// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "eigengrasp/jobs/database_statistics.hpp"
#include "eigengrasp/jobs/worker_name.hpp"

namespace eigengrasp {
namespace {

TEST(WorkerName, TellsTheLivingFromTheDead) {
  const std::string mine = worker_name(3);
  EXPECT_TRUE(mine.ends_with("/3")) << mine;
  EXPECT_FALSE(has_ended_here(mine));
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string name = worker_name(0);
    const bool written = write(ends[1], name.data(), name.size()) == static_cast<ssize_t>(name.size());
    _exit(written ? 0 : 1);
  }
  char text[300] = {};
  ASSERT_GT(read(ends[0], text, sizeof text - 1), 0);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(has_ended_here(text)) << text;
  EXPECT_EQ(host_of_worker(text), host_of_worker(mine));
  close(ends[0]);
  close(ends[1]);
}

TEST(WorkerName, KnowsNothingOfOthers) {
  const std::string mine = worker_name(0);
  EXPECT_FALSE(has_ended_here("elsewhere" + mine.substr(mine.rfind(':'))));
  for (const char* other : {"", "worker 1", "a:b", "a:1.2", "a:x.2/0"}) EXPECT_FALSE(has_ended_here(other));
  // The number of a living process, but of one that began at another time.
  const std::string reused = mine.substr(0, mine.rfind('.')) + ".1/0";
  EXPECT_TRUE(has_ended_here(reused));
}

TEST(Quantile, OfSortedValues) {
  EXPECT_EQ(quantile({}, 0.5), 0.0);
  EXPECT_EQ(quantile({3.0}, 0.9), 3.0);
  const std::vector<double> five{1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_EQ(quantile(five, 0.0), 1.0);
  EXPECT_EQ(quantile(five, 0.5), 3.0);
  EXPECT_EQ(quantile(five, 1.0), 5.0);
}

}  // namespace
}  // namespace eigengrasp
