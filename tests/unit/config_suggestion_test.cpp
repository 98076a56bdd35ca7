// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "service/config/suggestion.hpp"

namespace qwsm::config {
namespace {

TEST(EditDistance, CountsLettersAddedLostReplacedAndSwapped) {
  EXPECT_EQ(EditDistance("map", "map"), 0);
  EXPECT_EQ(EditDistance("map", "maps"), 1);
  EXPECT_EQ(EditDistance("map", "ap"), 1);
  EXPECT_EQ(EditDistance("map", "mop"), 1);
  EXPECT_EQ(EditDistance("map", "mpa"), 1);
  EXPECT_EQ(EditDistance("", "eval"), 4);
  EXPECT_EQ(EditDistance("sitting", "kitten"), 3);
}

TEST(ClosestName, FindsTheNearestOrNothing) {
  const std::vector<std::string> names{"max_iterations", "max_distance_m", "noise"};
  EXPECT_EQ(ClosestName("max_iteration", names), "max_iterations");
  EXPECT_EQ(ClosestName("max_distance", names), "max_distance_m");
  EXPECT_EQ(ClosestName("niose", names), "noise");
  EXPECT_EQ(ClosestName("banana", names), std::nullopt);
  EXPECT_EQ(ClosestName(std::string(100000, 'n'), names), std::nullopt);
}

TEST(DidYouMean, SaysNothingWithoutACandidate) {
  const std::vector<std::string> names{"noise"};
  EXPECT_EQ(DidYouMean("nois", names), "; did you mean 'noise'?");
  EXPECT_EQ(DidYouMean("banana", names), "");
}

}  // namespace
}  // namespace qwsm::config
