// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/text/json.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace qwsm::pipeline {
namespace {

TEST(Json, KeepsTheOrderOfMembers) {
  Json json;
  json["b"] = 1;
  json["a"]["deep"] = "text";
  json["b"] = 2;
  EXPECT_EQ(json.Line(),
            R"({"b":2,"a":{"deep":"text"}})"
            "\n");
}

TEST(Json, IndentsByTwo) {
  Json json;
  json["list"].Add(true);
  json["list"].Add(Json::Array());
  EXPECT_EQ(json.Text(), "{\n  \"list\": [\n    true,\n    []\n  ]\n}\n");
}

TEST(Json, WritesNumbersInFull) {
  Json json;
  json.Add(std::numeric_limits<std::uint64_t>::max());
  json.Add(-7);
  json.Add(0.1);
  json.Add(5.0);
  EXPECT_EQ(json.Line(), "[18446744073709551615,-7,0.1,5.0]\n");
}

TEST(Json, WritesNullForWhatJsonHasNoWordFor) {
  Json json;
  json.Add(std::numeric_limits<double>::quiet_NaN());
  json.Add(std::numeric_limits<double>::infinity());
  json.Add({});
  EXPECT_EQ(json.Line(), "[null,null,null]\n");
}

TEST(Json, EscapesTextAndReplacesWhatIsNotUtf8) {
  Json json;
  json["a \"quote\""] = "line\nand \xff";
  EXPECT_EQ(json.Line(), "{\"a \\\"quote\\\"\":\"line\\nand \xef\xbf\xbd\"}\n");
}

}  // namespace
}  // namespace qwsm::pipeline
