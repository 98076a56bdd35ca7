// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "service/io/logs/range_maximum.hpp"

namespace qwsm::io {
namespace {

/// Sweeps of a robot on its way: surfaces at all distances up to `reach_m`, the near ones more
/// often.
class Way {
 public:
  Way(std::uint32_t seed, double reach_m) : random_(seed), reach_m_(reach_m) {}

  float Surface() {
    const double share = std::uniform_real_distribution<double>(0.0, 1.0)(random_);
    return Centimetres(0.3 + (reach_m_ - 0.3) * share * share * share);
  }

  bool Happens(double probability) { return std::bernoulli_distribution(probability)(random_); }

  static float Centimetres(double value_m) {
    return static_cast<float>(std::round(value_m * 100.0) / 100.0);
  }

 private:
  std::mt19937 random_;
  double reach_m_;
};

float EstimateOf(int sweeps, double step_m, const std::function<float(int)>& reading) {
  RangeMaximumEstimator estimator;
  for (int i = 0; i < sweeps; ++i) {
    std::vector<float> ranges_m(180);
    for (float& range_m : ranges_m) range_m = reading(i);
    estimator.Add(ranges_m, Pose2{step_m * i, 0.0, 0.0});
  }
  return estimator.Estimate();
}

TEST(RangeMaximum, FindsTheValueForNoEcho) {
  for (const float no_echo_m : {81.91F, 81.83F, 51.15F, 50.0F, 30.0F, 8.183F, 5.6F}) {
    for (const double share : {0.005, 0.05, 0.5}) {
      SCOPED_TRACE(testing::Message() << no_echo_m << " in " << share);
      Way way(7, 0.9 * static_cast<double>(no_echo_m));
      const float found_m =
          EstimateOf(300, 0.2, [&](int) { return way.Happens(share) ? no_echo_m : way.Surface(); });
      EXPECT_EQ(found_m, no_echo_m);
    }
  }
}

TEST(RangeMaximum, TakesTheLargestOfSeveralCodes) {
  Way way(7, 7.9);
  EXPECT_EQ(EstimateOf(300,
                       0.2,
                       [&](int) {
                         if (way.Happens(0.001)) return 8.191F;
                         return way.Happens(0.05) ? 8.183F : way.Surface();
                       }),
            8.191F);
}

TEST(RangeMaximum, IsNotSpoiledByGarbage) {
  Way way(7, 40.0);
  int count = 0;
  EXPECT_EQ(EstimateOf(300,
                       0.2,
                       [&](int) {
                         ++count;
                         if (count == 5000) return 1e6F;
                         if (count == 9000) return 500.0F;
                         if (count == 9001) return std::nanf("");
                         return way.Happens(0.02) ? 50.0F : way.Surface();
                       }),
            50.0F);
}

TEST(RangeMaximum, LosesNothingOfALogWithoutMisses) {
  for (const double reach_m : {3.0, 12.0, 30.0, 70.0, 200.0}) {
    SCOPED_TRACE(reach_m);
    Way way(7, reach_m);
    const float found_m = EstimateOf(300, 0.2, [&](int) { return way.Surface(); });
    EXPECT_GT(0.97 * static_cast<double>(found_m), reach_m);
  }
}

TEST(RangeMaximum, DoesNotTakeAFarWallForOne) {
  // Standing still, a sixth of all beams meet the end of the corridor, and nothing is beyond.
  Way way(7, 15.0);
  const auto reading = [&](int) { return way.Happens(0.15) ? 20.0F : way.Surface(); };
  EXPECT_GT(EstimateOf(2000, 0.0, reading), 21.0F);
  // Driving towards it.
  const auto nearing = [&](int i) {
    return way.Happens(0.15) ? Way::Centimetres(20.0 - 0.1 * i) : way.Surface();
  };
  EXPECT_GT(EstimateOf(60, 0.1, nearing), 21.0F);
}

TEST(RangeMaximum, NeedsNoOdometry) {
  Way way(7, 40.0);
  RangeMaximumEstimator estimator;
  for (int i = 0; i < 300; ++i) {
    std::vector<float> ranges_m(180);
    for (float& range_m : ranges_m) range_m = way.Happens(0.02) ? 81.91F : way.Surface();
    estimator.Add(ranges_m, std::nullopt);
  }
  EXPECT_EQ(estimator.Estimate(), 81.91F);
}

}  // namespace
}  // namespace qwsm::io
