// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "service/io/files/numbered_name.hpp"

namespace qwsm::io {
namespace {

TEST(NumberedName, HasTheNumberAtItsEnd) {
  const NumberedName scan = NumberedName::Of("scan007");
  EXPECT_EQ(scan.name, "scan");
  EXPECT_EQ(scan.digits, "7");
  EXPECT_EQ(scan.Number(), 7U);
  EXPECT_EQ(NumberedName::Of("scan000").Number(), 0U);
  EXPECT_EQ(NumberedName::Of("12").name, "");
  EXPECT_EQ(NumberedName::Of("12").Number(), 12U);
}

TEST(NumberedName, HasNoneThatIsNotAtTheEndOrThatNothingHolds) {
  EXPECT_FALSE(NumberedName::Of("scan").Number());
  EXPECT_FALSE(NumberedName::Of("7th").Number());
  EXPECT_FALSE(NumberedName::Of("").Number());
  EXPECT_FALSE(NumberedName::Of("scan99999999999999999999").Number());
}

TEST(NumberedName, ComesInTheOrderOfNumbers) {
  const auto is_before = [](const char* a, const char* b) {
    return NumberedName::Of(a).Order() < NumberedName::Of(b).Order();
  };
  EXPECT_TRUE(is_before("scan9", "scan10"));
  EXPECT_TRUE(is_before("scan009", "scan10"));
  EXPECT_TRUE(is_before("scan99999999999999999998", "scan99999999999999999999"));
  EXPECT_FALSE(is_before("scan10", "scan9"));
  EXPECT_TRUE(is_before("a9", "b1"));
}

}  // namespace
}  // namespace qwsm::io
