// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/field_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "qwsm/geometry/position.hpp"
#include "qwsm/sensor/scan_limits.hpp"

namespace qwsm::io {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr double kMaxStamp_s = 9e9;  // The year 2255; nanoseconds in 64 bits end in 2262.

bool IsBlank(char c) { return c == ' ' || c == '\t'; }

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Printing with a sign always is common in logs, and std::from_chars does not know it.
std::string_view WithoutPlus(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return text;
}

/// ".5", "1.2e+09": rare, and not written by those who care for nanoseconds.
std::optional<Timestamp> ParseRoundedStamp(std::string_view seconds) {
  const std::optional<double> value_s = ParseNumber(seconds);
  if (!value_s || !(*value_s >= 0.0 && *value_s <= kMaxStamp_s)) return std::nullopt;
  return Timestamp(std::llround(*value_s * static_cast<double>(kNanosecondsPerSecond)));
}

/// What a number stands for that is out of the range of its type: next to nothing, or no end of it.
template <class Value>
Value OutOfRange(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE");
  const bool vanishes = exponent == std::string_view::npos
                            ? number.starts_with("0") || number.starts_with("-0")
                            : number.substr(exponent + 1).starts_with("-");
  if (vanishes) return Value{0};
  constexpr Value kInfinity = std::numeric_limits<Value>::infinity();
  return number.starts_with("-") ? -kInfinity : kInfinity;
}

}  // namespace

std::string_view Explain(FieldFault fault) {
  switch (fault) {
    case FieldFault::kEndsEarly:
      return "the line ends early; it was cut while recording or copying, or its count is wrong";
    case FieldFault::kNotANumber:
      return "a field is not a number; numbers may have run together, or the count is wrong";
    case FieldFault::kNotFinite:
      return "a pose or an angle is not finite; its source had failed, delete the line";
    case FieldFault::kTooFar:
      return "a position is more than 10000 km from the origin; its source had failed, or its unit "
             "is no metre";
    case FieldFault::kBadCount:
      return "the count of readings is not a whole number from 1 to 100000";
    case FieldFault::kBadStamp:
      return "the time stamp is missing or absurd; it is to be seconds since an epoch";
    case FieldFault::kBadGeometry:
      return "the stated bearings are no sweep of a laser; correct field of view and resolution";
    case FieldFault::kNoRotation:
      return "the quaternion is all zero and stands for no rotation";
    case FieldFault::kRepeated:
      return "a pose of this number or stamp stands before; leave the one that is meant";
    case FieldFault::kSurplus:
      return "the line goes on after its last field; the count of readings may be wrong";
    case FieldFault::kTooLong:
      return "the line is longer than 4 MiB; it may lack its line end";
    case FieldFault::kNotText:
      return "the line is not text; the file is damaged here or was copied wrongly";
    case FieldFault::kNoMessage:
      return "the line does not begin like a message; it was damaged, or comes from elsewhere";
    case FieldFault::kOddReadings:
      return "readings are negative or not finite; they count as invalid, the rest is used";
  }
  return "unknown fault";
}

bool IsPrintable(std::string_view word) {
  return std::ranges::all_of(word, [](char c) { return c > ' ' && c <= '~'; });
}

std::optional<double> ParseNumber(std::string_view text) {
  text = WithoutPlus(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Timestamp> ParseStamp(std::string_view seconds) {
  seconds = WithoutPlus(seconds);
  std::int64_t whole_s = 0;
  const char* const end = seconds.data() + seconds.size();
  auto [rest, error] = std::from_chars(seconds.data(), end, whole_s);
  if (error != std::errc() || !IsDigit(seconds.front())) return ParseRoundedStamp(seconds);
  if (rest != end && *rest++ != '.') return ParseRoundedStamp(seconds);
  if (static_cast<double>(whole_s) > kMaxStamp_s) return std::nullopt;
  std::int64_t nanoseconds = whole_s * kNanosecondsPerSecond;
  std::int64_t digit_value_ns = kNanosecondsPerSecond / 10;
  for (; rest != end; ++rest, digit_value_ns /= 10) {  // Digits beyond the ninth count nothing.
    if (!IsDigit(*rest)) return ParseRoundedStamp(seconds);
    nanoseconds += digit_value_ns * (*rest - '0');
  }
  return Timestamp(nanoseconds);
}

void FieldReader::Fail(FieldFault fault) {
  if (!fault_) fault_ = fault;
  text_ = {};
}

std::string_view FieldReader::Word() {
  const auto begin = std::find_if_not(text_.begin(), text_.end(), IsBlank);
  const auto end = std::find_if(begin, text_.end(), IsBlank);
  const std::string_view word(begin, end);
  text_ = std::string_view(end, text_.end());
  return word;
}

template <class Value>
Value FieldReader::Parse() {
  while (!text_.empty() && IsBlank(text_.front())) text_.remove_prefix(1);
  text_ = WithoutPlus(text_);
  Value value{};
  const char* const end = text_.data() + text_.size();
  const auto [rest, error] = std::from_chars(text_.data(), end, value);
  // Out of range is a number all the same: an infinite or a vanishing one, which later checks
  // judge.
  if (error == std::errc::invalid_argument || (rest != end && !IsBlank(*rest))) {
    Fail(text_.empty() ? FieldFault::kEndsEarly : FieldFault::kNotANumber);
    return Value{};
  }
  const std::string_view number(text_.data(), static_cast<std::size_t>(rest - text_.data()));
  text_.remove_prefix(number.size());
  return error == std::errc() ? value : OutOfRange<Value>(number);
}

double FieldReader::Number() {
  const auto value = Parse<double>();
  if (std::isfinite(value)) return value;
  Fail(FieldFault::kNotFinite);
  return 0.0;
}

std::size_t FieldReader::Count(std::size_t least) {
  const std::string_view word = WithoutPlus(Word());
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  if (whole && count >= least && count <= kMostBeams) return count;
  Fail(word.empty() ? FieldFault::kEndsEarly : FieldFault::kBadCount);
  return 0;
}

double FieldReader::Coordinate() {
  const double coordinate_m = Number();
  if (IsCoordinate(coordinate_m)) return coordinate_m;
  Fail(FieldFault::kTooFar);
  return 0.0;
}

Pose2 FieldReader::Pose() {
  const double x_m = Coordinate();
  const double y_m = Coordinate();
  const double theta_rad = Number();
  return {x_m, y_m, NormalizeAngle(theta_rad)};
}

Timestamp FieldReader::Stamp() {
  const std::optional<Timestamp> stamp = ParseStamp(Word());
  if (!stamp) Fail(FieldFault::kBadStamp);
  return stamp.value_or(Timestamp{});
}

float FieldReader::Range() {
  const auto range_m = Parse<float>();
  odd_readings_ |= !(range_m >= 0.0F && range_m <= std::numeric_limits<float>::max());
  return range_m;
}

std::vector<float> FieldReader::Ranges(std::size_t count, std::size_t others) {
  std::vector<float> ranges_m;
  // A count the line is too short for must not cost memory.
  if (count * (others + 1) > text_.size()) Fail(FieldFault::kEndsEarly);
  if (fault_) return ranges_m;
  ranges_m.reserve(count);
  for (std::size_t i = 0; i < count && !fault_; ++i) {
    ranges_m.push_back(Range());
    Skip(others);
  }
  return ranges_m;
}

void FieldReader::Skip(std::size_t words) {
  for (std::size_t i = 0; i < words; ++i) {
    if (Word().empty()) return Fail(FieldFault::kEndsEarly);
  }
}

void FieldReader::ExpectEnd() {
  if (!AtEnd()) Fail(FieldFault::kSurplus);
}

std::size_t FieldReader::WordsLeft() const {
  FieldReader rest(text_);
  std::size_t count = 0;
  while (!rest.Word().empty()) ++count;
  return count;
}

bool FieldReader::AtEnd() {
  while (!text_.empty() && IsBlank(text_.front())) text_.remove_prefix(1);
  return text_.empty();
}

}  // namespace qwsm::io
