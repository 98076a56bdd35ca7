// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/number_text.hpp"

#include <array>
#include <charconv>
#include <cstdint>

namespace qwsm::io {
namespace {

template <class Value>
void AppendShortest(std::string& text, Value value) {
  std::array<char, 32> digits;  // NOLINT(cppcoreguidelines-pro-type-member-init): written next.
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
}

}  // namespace

void AppendNumber(std::string& text, double value) { AppendShortest(text, value); }
void AppendNumber(std::string& text, float value) { AppendShortest(text, value); }

void AppendStamp(std::string& text, Timestamp stamp) {
  constexpr std::int64_t kPerSecond = 1'000'000'000;
  const bool negative = stamp < Timestamp::zero();
  // Unsigned, as the most negative number has no positive counterpart.
  const std::uint64_t count = negative
                                  ? std::uint64_t{0} - static_cast<std::uint64_t>(stamp.count())
                                  : static_cast<std::uint64_t>(stamp.count());
  if (negative) text += '-';
  AppendShortest(text, count / kPerSecond);
  const std::string decimals = std::to_string(count % kPerSecond);
  text += '.';
  text.append(9 - decimals.size(), '0');
  text += decimals;
}

}  // namespace qwsm::io
