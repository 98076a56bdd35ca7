// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "service/io/files/line_reader.hpp"

namespace qwsm::io {
namespace {

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream stream(text);
  LineReader reader{ByteSource(stream)};
  std::vector<std::string> lines;
  while (const std::optional<Line> line = reader.Next()) {
    lines.emplace_back(line->text);
    EXPECT_EQ(line->number, lines.size());
  }
  return lines;
}

TEST(LineReader, CutsLinesWhateverTheirEnds) {
  EXPECT_EQ(LinesOf("a\nbc\r\n\nd"), (std::vector<std::string>{"a", "bc", "", "d"}));
  EXPECT_EQ(LinesOf("a\n"), std::vector<std::string>{"a"});
  EXPECT_TRUE(LinesOf("").empty());
}

TEST(LineReader, DropsAByteOrderMark) {
  EXPECT_EQ(LinesOf("\xef\xbb\xbf"
                    "ODOM\nx\n"),
            (std::vector<std::string>{"ODOM", "x"}));
}

TEST(LineReader, ReadsLinesLongerThanItsFirstBuffer) {
  const std::string long_line(1'000'000, 'x');
  EXPECT_EQ(LinesOf("a\n" + long_line + "\nb\n"), (std::vector<std::string>{"a", long_line, "b"}));
}

TEST(LineReader, ReadsOverALineWithoutEnd) {
  std::istringstream stream("a\n" + std::string(3 * kMaxLineBytes, 'x') + "\nb\n");
  LineReader reader{ByteSource(stream)};
  EXPECT_EQ(reader.Next()->text, "a");
  const std::optional<Line> line = reader.Next();
  EXPECT_TRUE(line->too_long);
  EXPECT_EQ(line->number, 2U);
  EXPECT_TRUE(line->text.starts_with("xxx"));
  EXPECT_EQ(reader.Next()->text, "b");
  EXPECT_FALSE(reader.Next().has_value());
}

}  // namespace
}  // namespace qwsm::io
