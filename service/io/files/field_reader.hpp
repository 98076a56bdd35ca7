// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// Says what is wrong with a line of text.
enum class FieldFault {
  kEndsEarly,
  kNotANumber,
  kNotFinite,
  kTooFar,
  kBadCount,
  kBadStamp,
  kBadGeometry,
  kNoRotation,
  kRepeated,
  kSurplus,
  kTooLong,
  kNotText,
  kNoMessage,
  /// Readings that are negative or not finite; the only fault that leaves the line usable.
  kOddReadings,
};

/// Explains the cause and its remedy, to follow "FLASER: ".
std::string_view Explain(FieldFault fault);

/// Whether a word is of printable ASCII.
bool IsPrintable(std::string_view word);

/// Reads the fields of one line from left to right.
///
/// Like a stream it remembers its first failure: what is read after that is zero, so that a parser
/// reads straight on and asks for `fault()` once, at the end.
class FieldReader {
 public:
  explicit FieldReader(std::string_view text) : text_(text) {}

  /// The next field; empty at the end, which is no failure.
  std::string_view Word();
  /// The next field as a finite number.
  double Number();
  /// The next field as a whole number from `least` to kMostBeams.
  std::size_t Count(std::size_t least);
  /// The next field as a coordinate in metres.
  double Coordinate();
  /// The next three fields as x, y (metres) and theta (radians).
  Pose2 Pose();
  /// The next field as seconds since the epoch, exact to the nanosecond.
  Timestamp Stamp();
  /// The next field as a range in metres, finite or not.
  float Range();
  /// The next `count` fields as ranges in metres; `others` fields follow each and are read over.
  std::vector<float> Ranges(std::size_t count, std::size_t others = 0);
  void Skip(std::size_t words);
  /// Fails where fields are left.
  void ExpectEnd();
  /// Fails for a reason the caller knows.
  void Fail(FieldFault fault);

  bool AtEnd();
  std::size_t WordsLeft() const;
  const std::optional<FieldFault>& fault() const { return fault_; }
  /// Whether a range was negative or not finite.
  bool odd_readings() const { return odd_readings_; }

 private:
  template <class Value>
  Value Parse();

  std::string_view text_;
  std::optional<FieldFault> fault_;
  bool odd_readings_ = false;
};

/// The stamp that a text of decimal seconds spells, without rounding through a double; nothing
/// where that is no time since an epoch.
std::optional<Timestamp> ParseStamp(std::string_view seconds);

/// The number that a text spells, and nothing else; a leading plus is allowed.
std::optional<double> ParseNumber(std::string_view text);

}  // namespace qwsm::io
