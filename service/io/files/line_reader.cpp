// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/line_reader.hpp"

#include <algorithm>
#include <cstring>

namespace qwsm::io {
namespace {

constexpr std::size_t kFirstBufferBytes = std::size_t{1} << 18U;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

LineReader::LineReader(ByteSource source)
    : source_(std::move(source)), buffer_(kFirstBufferBytes) {}

std::optional<Line> LineReader::Next() {
  if (in_long_line_) DropLongLine();
  while (true) {
    if (const char* line_end = FindLineEnd()) {
      const auto size = static_cast<std::size_t>(line_end - buffer_.data()) - begin_;
      Line line = Cut(size);
      line.too_long = size > kMaxLineBytes;
      begin_ = searched_ = begin_ + size + 1;
      return line;
    }
    if (end_ - begin_ > kMaxLineBytes) {
      Line line = Cut(kMaxLineBytes);
      line.too_long = true;
      in_long_line_ = true;
      begin_ = end_;
      return line;
    }
    if (Refill()) continue;
    if (begin_ == end_) return std::nullopt;
    const Line line = Cut(end_ - begin_);
    begin_ = searched_ = end_;
    return line;
  }
}

/// The next line end in the buffer, or null: then everything has been searched.
const char* LineReader::FindLineEnd() {
  const void* found = std::memchr(buffer_.data() + searched_, '\n', end_ - searched_);
  searched_ = end_;
  return static_cast<const char*>(found);
}

/// Reads more behind the unfinished line; false at the end of the source.
bool LineReader::Refill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    searched_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  const std::size_t count = source_.Read({buffer_.data() + end_, buffer_.size() - end_});
  end_ += count;
  return count > 0;
}

Line LineReader::Cut(std::size_t size) {
  std::string_view text(buffer_.data() + begin_, size);
  if (line_number_ == 0 && text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  if (text.ends_with('\r')) text.remove_suffix(1);
  return {.number = ++line_number_, .text = text};
}

void LineReader::DropLongLine() {
  do {
    begin_ = end_;
    if (const char* line_end = FindLineEnd()) {
      begin_ = searched_ = static_cast<std::size_t>(line_end + 1 - buffer_.data());
      break;
    }
  } while (Refill());
  in_long_line_ = false;
}

}  // namespace qwsm::io
