// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/repeat_filter.hpp"

#include <gtest/gtest.h>

#include <string>

namespace qwsm::pipeline {
namespace {

using namespace std::chrono_literals;

TEST(RepeatFilter, HoldsBackWhatWasJustSaidAndCountsIt) {
  RepeatFilter filter(10s);
  const RepeatFilter::Clock::time_point begin{};
  EXPECT_EQ(filter.Pass("disk full", begin), 0U);
  EXPECT_EQ(filter.Pass("joined", begin), 0U);
  for (int i = 1; i < 10; ++i) {
    EXPECT_FALSE(filter.Pass("disk full", begin + i * 1s).has_value());
  }
  EXPECT_EQ(filter.Pass("disk full", begin + 10s), 9U);
  EXPECT_FALSE(filter.Pass("disk full", begin + 19s).has_value());
  EXPECT_EQ(filter.Pass("disk full", begin + 20s), 1U);
}

TEST(RepeatFilter, DoesNotGrowWithWhatStrangersSay) {
  RepeatFilter filter(10s);
  const RepeatFilter::Clock::time_point now{};
  EXPECT_EQ(filter.Pass("robot0", now), 0U);
  for (int i = 1; i <= 1000; ++i) filter.Pass("robot" + std::to_string(i), now);
  EXPECT_EQ(filter.Pass("robot0", now), 0U);  // Forgotten.
}

}  // namespace
}  // namespace qwsm::pipeline
