// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/messages/message_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace qwsm::io {
namespace {

constexpr std::size_t kCdrHead = 4;

// The second byte of CDR's head; the first is 0.
enum Encapsulation : std::uint8_t {
  kBigEndian = 0,
  kLittleEndian = 1,
  kBigEndian2 = 6,  // Plain XCDR2.
  kLittleEndian2 = 7,
};

}  // namespace

MessageReader::MessageReader(std::string_view bytes, Encoding encoding)
    : bytes_(bytes), encoding_(encoding) {
  if (encoding_ != Encoding::kCdr) {
    widest_alignment_ = 1;
    return;
  }
  if (bytes.size() < kCdrHead) throw MessageError("it is shorter than the head of CDR");
  const auto kind = static_cast<std::uint8_t>(bytes[1]);
  const bool is_2 = kind == kBigEndian2 || kind == kLittleEndian2;
  if (bytes[0] != 0 || !(is_2 || kind == kBigEndian || kind == kLittleEndian)) {
    throw MessageError("its CDR is neither plain XCDR1 nor plain XCDR2");
  }
  is_big_endian_ = kind == kBigEndian || kind == kBigEndian2;
  if (is_2) widest_alignment_ = 4;
  bytes_.remove_prefix(kCdrHead);
}

template <class Number>
Number MessageReader::Take() {
  const std::size_t alignment = std::min(sizeof(Number), widest_alignment_);
  const std::size_t begin = (at_ + alignment - 1) / alignment * alignment;
  if (begin > bytes_.size() || bytes_.size() - begin < sizeof(Number)) {
    throw MessageError("it ends in the middle of a field");
  }
  char raw[sizeof(Number)];
  std::memcpy(raw, bytes_.data() + begin, sizeof(Number));
  if (is_big_endian_ != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
  at_ = begin + sizeof(Number);
  Number value;
  std::memcpy(&value, raw, sizeof(Number));
  return value;
}

std::uint8_t MessageReader::Byte() { return Take<std::uint8_t>(); }
std::uint32_t MessageReader::Unsigned32() { return Take<std::uint32_t>(); }
float MessageReader::Float() { return Take<float>(); }
double MessageReader::Double() { return Take<double>(); }

std::vector<float> MessageReader::Floats(std::size_t at_most) {
  const std::size_t count = Count(sizeof(float));  // Behind which they are aligned.
  if (count > at_most) {
    throw MessageError("it has more than " + std::to_string(at_most) + " numbers in a row");
  }
  std::vector<float> values(count);
  if (is_big_endian_ != (std::endian::native == std::endian::big)) {
    for (float& value : values) value = Float();
  } else if (count > 0) {
    const std::string_view raw = Bytes(count * sizeof(float));
    std::memcpy(values.data(), raw.data(), raw.size());
  }
  return values;
}

std::string_view MessageReader::Bytes(std::size_t size) {
  if (size > bytes_.size() - at_) throw MessageError("a length in it is beyond its end");
  const std::string_view taken = bytes_.substr(at_, size);
  at_ += size;
  return taken;
}

std::string MessageReader::String() {
  const std::uint32_t length = Unsigned32();
  std::string text(Bytes(length));
  if (encoding_ != Encoding::kCdr) return text;
  if (!text.empty() && text.back() == '\0') text.pop_back();  // CDR counts the end of the text.
  return text;
}

std::size_t MessageReader::Count(std::size_t bytes_each) {
  const std::size_t count = Unsigned32();
  if (count > (bytes_.size() - at_) / bytes_each) {
    throw MessageError("a length in it is beyond its end");
  }
  return count;
}

}  // namespace qwsm::io
