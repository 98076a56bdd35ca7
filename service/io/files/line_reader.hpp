// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "service/io/files/byte_source.hpp"

namespace qwsm::io {

/// A line longer than this is read over: 100 000 readings with their intensities take less.
inline constexpr std::size_t kMaxLineBytes = std::size_t{4} << 20U;

/// One line of text, valid until the next one is read.
struct Line {
  std::size_t number = 0;  ///< Number of the line, counted from 1.
  std::string_view text;   ///< Without line end, carriage return and byte order mark.
  /// Whether the line is longer than kMaxLineBytes; then `text` may be only its beginning.
  bool too_long = false;
};

/// Cuts the bytes of a source into lines, in bounded memory.
class LineReader {
 public:
  explicit LineReader(ByteSource source);

  /// The next line, the last one with or without a line end; nothing at the end.
  /// @throws std::runtime_error as ByteSource::Read does; a line cut by the damage is dropped.
  std::optional<Line> Next();

  const ByteSource& source() const { return source_; }

 private:
  const char* FindLineEnd();
  bool Refill();
  Line Cut(std::size_t size);
  void DropLongLine();

  ByteSource source_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;     // Begin of what is not yet given out.
  std::size_t end_ = 0;       // End of what was read.
  std::size_t searched_ = 0;  // There is no line end before here.
  std::size_t line_number_ = 0;
  bool in_long_line_ = false;  // Whether everything up to the next line end is dropped.
};

}  // namespace qwsm::io
