// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

#include "qwsm/geometry/angle.hpp"
#include "service/config/number_text.hpp"

namespace qwsm::config {
namespace {

TEST(ParseNumber, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(ParseNumber("1.5"), 1.5);
  EXPECT_EQ(ParseNumber("+3"), 3.0);
  EXPECT_EQ(ParseNumber("1e-4"), 1e-4);
  for (const char* text :
       {"", "soon", "1.5 m", " 1", "0x10", "+-1", "1,5", "nan", "inf", "1e999"}) {
    EXPECT_EQ(ParseNumber(text), std::nullopt) << text;
  }
}

TEST(ParseWholeNumber, RefusesFractionsAndOverflow) {
  EXPECT_EQ(ParseWholeNumber("-7"), -7);
  for (const char* text : {"1.0", "1e3", "2147483648", "", "-"}) {
    EXPECT_EQ(ParseWholeNumber(text), std::nullopt) << text;
  }
}

TEST(NumberText, ReadsBackExactlyWhateverTheBits) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(ParseNumber(NumberText(value)), value);
  }
}

TEST(DegreesText, ReadsBackExactlyWhateverTheAngle) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> angle_rad(-4.0, 4.0);
  for (int i = 0; i < 20000; ++i) {
    const double value_rad = angle_rad(random) * (i % 2 == 0 ? 1.0 : 1e-6);
    EXPECT_EQ(ParseDegrees(DegreesText(value_rad)), value_rad) << DegreesText(value_rad);
  }
  EXPECT_EQ(ParseDegrees(DegreesText(0.002)), 0.002);
}

TEST(DegreesText, WritesWholeDegreesAsSuch) {
  for (const int degrees :
       {0, 1, 2, 5, 9, 10, 20, 30, 45, 60, 90, 100, 120, 180, 240, 270, 360, -90}) {
    EXPECT_EQ(DegreesText(DegreesToRadians(degrees)), std::to_string(degrees));
  }
  EXPECT_EQ(DegreesText(DegreesToRadians(0.25)), "0.25");
}

}  // namespace
}  // namespace qwsm::config
