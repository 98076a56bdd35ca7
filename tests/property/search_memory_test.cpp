// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/detail/search_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace qwsm {
namespace {

TEST(SearchMemory, WhatIsTakenStaysAndOverlapsNothingElse) {
  for (unsigned seed = 0; seed < 5; ++seed) {  // Pages of the ones before are used again.
    std::mt19937_64 random(seed);
    SearchMemory memory;
    std::vector<std::span<std::uint32_t>> taken;
    for (std::uint32_t i = 0; i < 200; ++i) {
      // Some of it fits no page.
      const std::size_t most = i % 50 == 0 ? 100000 : 3000;
      const std::size_t count = std::uniform_int_distribution<std::size_t>(0, most)(random);
      const bool zeros = i % 2 == 0;
      taken.push_back(zeros ? memory.TakeZeros<std::uint32_t>(count)
                            : memory.Take<std::uint32_t>(count));
      ASSERT_EQ(taken.back().size(), count);
      if (zeros) {
        EXPECT_EQ(std::ranges::count(taken.back(), 0U), static_cast<std::ptrdiff_t>(count));
      }
      std::ranges::fill(taken.back(), i);
    }
    for (std::uint32_t i = 0; i < taken.size(); ++i) {
      EXPECT_EQ(std::ranges::count(taken[i], i), static_cast<std::ptrdiff_t>(taken[i].size()));
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(taken[i].data()) % 16, 0U);
    }
  }
}

TEST(SearchMemory, SearchesAtATimeShareNothing) {
  SearchMemory first;
  SearchMemory second;
  const auto ones = first.Take<int>(1000);
  const auto twos = second.Take<int>(1000);
  std::ranges::fill(ones, 1);
  std::ranges::fill(twos, 2);
  EXPECT_EQ(std::ranges::count(ones, 1), 1000);
  EXPECT_EQ(std::ranges::count(twos, 2), 1000);
}

}  // namespace
}  // namespace qwsm
