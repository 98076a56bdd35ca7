// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "service/io/files/field_reader.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

TEST(ParseStamp, KeepsEveryDigitToTheNanosecond) {
  EXPECT_EQ(ParseStamp("976052857.337531"), 976052857337531us);
  EXPECT_EQ(ParseStamp("1.000000001"), 1000000001ns);
  EXPECT_EQ(ParseStamp("0021.5"), 21500ms);
  EXPECT_EQ(ParseStamp("7"), 7s);
  EXPECT_EQ(ParseStamp("7."), 7s);
  EXPECT_EQ(ParseStamp("+7.1"), 7100ms);
  EXPECT_EQ(ParseStamp("0.1234567899999"), 123456789ns);
}

TEST(ParseStamp, ReadsOtherNotationsToo) {
  EXPECT_EQ(ParseStamp(".5"), 500ms);
  EXPECT_EQ(ParseStamp("1.5e3"), 1500s);
}

TEST(ParseStamp, RefusesWhatIsNoTimeSinceAnEpoch) {
  for (const std::string text : {"",
                                 "x",
                                 "-1",
                                 "nan",
                                 "inf",
                                 "1e30",
                                 "99999999999",
                                 "1.5x",
                                 "1.2.3",
                                 "9300000000",
                                 "123456789012345678901234567890"}) {
    EXPECT_FALSE(ParseStamp(text).has_value()) << text;
  }
}

TEST(FieldReader, ReadsFieldsInTurn) {
  FieldReader fields("FLASER  2\t+1.5 -0.25 end");
  EXPECT_EQ(fields.Word(), "FLASER");
  EXPECT_EQ(fields.Count(1), 2U);
  EXPECT_EQ(fields.Ranges(2), (std::vector{1.5F, -0.25F}));
  EXPECT_TRUE(fields.odd_readings());
  EXPECT_EQ(fields.WordsLeft(), 1U);
  EXPECT_EQ(fields.Word(), "end");
  EXPECT_TRUE(fields.AtEnd());
  EXPECT_FALSE(fields.fault().has_value());
}

TEST(FieldReader, KeepsItsFirstFault) {
  FieldReader fields("1.0 2.03.0 4");
  EXPECT_EQ(fields.Number(), 1.0);
  EXPECT_EQ(fields.Number(), 0.0);
  EXPECT_EQ(fields.Number(), 0.0);
  EXPECT_EQ(fields.fault(), FieldFault::kNotANumber);
}

TEST(FieldReader, TellsTheFaultsApart) {
  const auto fault_of_number = [](const char* text) {
    FieldReader fields(text);
    fields.Number();
    return fields.fault();
  };
  EXPECT_EQ(fault_of_number(""), FieldFault::kEndsEarly);
  EXPECT_EQ(fault_of_number("x"), FieldFault::kNotANumber);
  EXPECT_EQ(fault_of_number("nan"), FieldFault::kNotFinite);
  EXPECT_EQ(fault_of_number("-inf"), FieldFault::kNotFinite);
  EXPECT_EQ(fault_of_number("1e999"), FieldFault::kNotFinite);
  EXPECT_EQ(fault_of_number("1e-999"), std::nullopt);
  const auto fault_of_count = [](const char* text) {
    FieldReader fields(text);
    fields.Count(1);
    return fields.fault();
  };
  EXPECT_EQ(fault_of_count("0"), FieldFault::kBadCount);
  EXPECT_EQ(fault_of_count("-5"), FieldFault::kBadCount);
  EXPECT_EQ(fault_of_count("1.5"), FieldFault::kBadCount);
  EXPECT_EQ(fault_of_count("1000000"), FieldFault::kBadCount);
  EXPECT_EQ(fault_of_count("0180"), std::nullopt);
}

TEST(FieldReader, NeedsNoMemoryForReadingsThatAreNotThere) {
  FieldReader fields("1.0 2.0");
  EXPECT_EQ(fields.Ranges(100'000).capacity(), 0U);
  EXPECT_EQ(fields.fault(), FieldFault::kEndsEarly);
}

TEST(FieldReader, KeepsReadingsThatAreNotFinite) {
  FieldReader fields("nan inf -inf 1e99");
  const std::vector<float> ranges_m = fields.Ranges(4);
  ASSERT_EQ(ranges_m.size(), 4U);
  EXPECT_TRUE(std::isnan(ranges_m[0]));
  EXPECT_EQ(ranges_m[1], std::numeric_limits<float>::infinity());
  EXPECT_EQ(ranges_m[2], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(ranges_m[3], std::numeric_limits<float>::infinity());
  EXPECT_TRUE(fields.odd_readings());
}

}  // namespace
}  // namespace qwsm::io
