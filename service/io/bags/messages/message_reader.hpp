// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/io/bags/containers/message_source.hpp"

namespace qwsm::io {

/// Tells that a message is not what its type says; the text names neither topic nor file.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Takes the fields of a message in their order, in either of the two serialisations: CDR (XCDR1,
/// or plain XCDR2, of either byte order; OMG DDS-XTypes 1.3, 7.4) aligns them, ROS 1 does not.
///
/// All functions throw MessageError at the end of the bytes, and where a length is beyond it.
class MessageReader {
 public:
  /// Begins to read. @throws MessageError where CDR is not of these kinds.
  MessageReader(std::string_view bytes, Encoding encoding);

  std::uint8_t Byte();
  std::uint32_t Unsigned32();
  float Float();
  double Double();
  std::string String();
  /// The number of things in a sequence, of at least `bytes_each`, which are there: safe to
  /// allocate for.
  std::size_t Count(std::size_t bytes_each);
  /// A sequence of numbers, at most so many.
  std::vector<float> Floats(std::size_t at_most);
  /// Bytes as they are, without alignment.
  std::string_view Bytes(std::size_t size);

  Encoding encoding() const { return encoding_; }

 private:
  template <class Number>
  Number Take();

  std::string_view bytes_;  // Behind the head of CDR, from which alignment counts.
  std::size_t at_ = 0;
  Encoding encoding_;
  bool is_big_endian_ = false;
  std::size_t widest_alignment_ = 8;
};

}  // namespace qwsm::io
