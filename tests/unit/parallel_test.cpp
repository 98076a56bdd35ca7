// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace qwsm::pipeline {
namespace {

TEST(RunInParallel, DoesEachTaskOnce) {
  std::vector<std::atomic<int>> done(100);
  std::vector<std::function<void()>> tasks;
  for (std::atomic<int>& count : done) tasks.emplace_back([&count] { ++count; });
  RunInParallel(tasks);
  for (const std::atomic<int>& count : done) EXPECT_EQ(count, 1);
  RunInParallel({});
}

TEST(RunInParallel, DoesTheOthersWhereSomeFailAndTellsOfTheFirst) {
  std::atomic<int> done = 0;
  const auto succeed = [&done] { ++done; };
  const auto fail = [](const std::string& why) { return [why] { throw std::runtime_error(why); }; };
  const std::vector<std::function<void()>> tasks{succeed, fail("a"), succeed, fail("b"), succeed};
  try {
    RunInParallel(tasks);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "a");
  }
  EXPECT_EQ(done, 3);
}

}  // namespace
}  // namespace qwsm::pipeline
