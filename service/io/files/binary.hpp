// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace qwsm::io {

/// Puts numbers one after the other, little endian and unaligned, on any machine.
class BinaryWriter {
 public:
  void Add(std::uint8_t value);
  void Add(std::uint16_t value);
  void Add(std::uint32_t value);
  void Add(std::uint64_t value);
  void Add(std::int64_t value);
  void Add(float value);
  void Add(double value);
  /// Adds a text: its length, then its bytes.
  void Add(std::string_view text);
  /// Adds bytes as they are.
  void AddBytes(std::string_view bytes) { bytes_ += bytes; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// CRC-32 of the bytes, as of zlib.
std::uint32_t Checksum(std::string_view bytes);

/// Tells that there are fewer bytes than what they claim to hold.
class BinaryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Takes out the numbers that BinaryWriter put in. All functions throw BinaryError at the end of
/// the bytes.
class BinaryReader {
 public:
  explicit BinaryReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t Unsigned8();
  std::uint16_t Unsigned16();
  std::uint32_t Unsigned32();
  std::uint64_t Unsigned64();
  std::int64_t Signed64();
  float Float();
  double Double();
  std::string_view Text();
  /// Takes so many bytes as they are.
  std::string_view Bytes(std::uint64_t size);
  /// Takes a number of things of at least `bytes_each`, which are there: safe to allocate for.
  std::size_t Count(std::size_t bytes_each);

  std::size_t remaining() const { return bytes_.size() - at_; }

 private:
  std::string_view Take(std::size_t size);

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace qwsm::io
