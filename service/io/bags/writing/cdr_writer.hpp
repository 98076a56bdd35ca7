// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace qwsm::io {

/// Puts the fields of a message one after the other as ROS 2 does: CDR (XCDR1), little endian, each
/// aligned to its size, behind a head that says so.
class CdrWriter {
 public:
  CdrWriter();

  void Add(std::uint8_t value);
  void Add(std::int32_t value);
  void Add(std::uint32_t value);
  void Add(float value);
  void Add(double value);
  void Add(std::string_view text);
  /// Adds bytes as they are.
  void AddBytes(std::string_view bytes) { bytes_ += bytes; }

  const std::string& bytes() const { return bytes_; }

 private:
  template <class Number>
  void AddAligned(Number value);

  std::string bytes_;
};

}  // namespace qwsm::io
