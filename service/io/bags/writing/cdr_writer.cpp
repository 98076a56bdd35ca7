// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/cdr_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace qwsm::io {
namespace {

using std::literals::operator""sv;

constexpr std::string_view kLittleEndianHead = "\0\1\0\0"sv;

}  // namespace

CdrWriter::CdrWriter() : bytes_(kLittleEndianHead) {}

template <class Number>
void CdrWriter::AddAligned(Number value) {
  while ((bytes_.size() - kLittleEndianHead.size()) % sizeof(Number) != 0) bytes_.push_back('\0');
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
  bytes_.append(raw, sizeof(Number));
}

void CdrWriter::Add(std::uint8_t value) { AddAligned(value); }
void CdrWriter::Add(std::int32_t value) { AddAligned(value); }
void CdrWriter::Add(std::uint32_t value) { AddAligned(value); }
void CdrWriter::Add(float value) { AddAligned(value); }
void CdrWriter::Add(double value) { AddAligned(value); }

void CdrWriter::Add(std::string_view text) {
  Add(static_cast<std::uint32_t>(text.size() + 1));  // CDR counts the end of the text.
  bytes_.append(text);
  bytes_.push_back('\0');
}

}  // namespace qwsm::io
