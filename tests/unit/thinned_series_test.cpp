// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/thinned_series.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace qwsm::pipeline {
namespace {

TEST(ThinnedSeries, KeepsAllUntilItIsFull) {
  ThinnedSeries<int> series(4);
  for (int i = 0; i < 4; ++i) series.Add(i);
  EXPECT_EQ(series.elements(), (std::vector<int>{0, 1, 2, 3}));
}

TEST(ThinnedSeries, StaysBoundedAndEvenlySpread) {
  constexpr std::size_t kCapacity = 10;
  ThinnedSeries<int> series(kCapacity);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    series.Add(i);
    const std::vector<int>& kept = series.elements();
    ASSERT_LE(kept.size(), kCapacity);
    const int stride = kept.size() > 1 ? kept[1] - kept[0] : 1;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      ASSERT_EQ(kept[k], static_cast<int>(k) * stride);
    }
    ASSERT_LT(i - kept.back(), stride);
  }
}

}  // namespace
}  // namespace qwsm::pipeline
