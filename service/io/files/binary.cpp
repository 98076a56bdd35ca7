// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/binary.hpp"

#include <zlib.h>

#include <bit>
#include <concepts>

namespace qwsm::io {
namespace {

template <std::unsigned_integral Number>
void AppendBytes(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes.push_back(static_cast<char>((value >> (8 * i)) & 0xFF));
  }
}

template <std::unsigned_integral Number>
Number Assemble(std::string_view bytes) {
  Number value = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    value |= static_cast<Number>(static_cast<Number>(byte) << (8 * i));
  }
  return value;
}

}  // namespace

std::uint32_t Checksum(std::string_view bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(crc32_z(crc32_z(0, nullptr, 0), data, bytes.size()));
}

void BinaryWriter::Add(std::uint8_t value) { AppendBytes(bytes_, value); }
void BinaryWriter::Add(std::uint16_t value) { AppendBytes(bytes_, value); }
void BinaryWriter::Add(std::uint32_t value) { AppendBytes(bytes_, value); }
void BinaryWriter::Add(std::uint64_t value) { AppendBytes(bytes_, value); }
void BinaryWriter::Add(std::int64_t value) {
  AppendBytes(bytes_, static_cast<std::uint64_t>(value));
}
void BinaryWriter::Add(float value) { AppendBytes(bytes_, std::bit_cast<std::uint32_t>(value)); }
void BinaryWriter::Add(double value) { AppendBytes(bytes_, std::bit_cast<std::uint64_t>(value)); }
void BinaryWriter::Add(std::string_view text) {
  Add(static_cast<std::uint32_t>(text.size()));
  bytes_ += text;
}

std::uint8_t BinaryReader::Unsigned8() { return Assemble<std::uint8_t>(Take(1)); }
std::uint16_t BinaryReader::Unsigned16() {
  return Assemble<std::uint16_t>(Take(sizeof(std::uint16_t)));
}
std::uint32_t BinaryReader::Unsigned32() {
  return Assemble<std::uint32_t>(Take(sizeof(std::uint32_t)));
}
std::uint64_t BinaryReader::Unsigned64() {
  return Assemble<std::uint64_t>(Take(sizeof(std::uint64_t)));
}
std::int64_t BinaryReader::Signed64() { return static_cast<std::int64_t>(Unsigned64()); }
float BinaryReader::Float() { return std::bit_cast<float>(Unsigned32()); }
double BinaryReader::Double() { return std::bit_cast<double>(Unsigned64()); }
std::string_view BinaryReader::Text() { return Take(Unsigned32()); }

std::string_view BinaryReader::Bytes(std::uint64_t size) {
  if (size > remaining()) throw BinaryError("claims to hold more than there is");
  return Take(static_cast<std::size_t>(size));
}

std::size_t BinaryReader::Count(std::size_t bytes_each) {
  const std::uint64_t count = Unsigned64();
  if (count > remaining() / bytes_each) throw BinaryError("claims to hold more than there is");
  return static_cast<std::size_t>(count);
}

std::string_view BinaryReader::Take(std::size_t size) {
  if (size > remaining()) throw BinaryError("ends in the middle of a number");
  const std::string_view taken = bytes_.substr(at_, size);
  at_ += size;
  return taken;
}

}  // namespace qwsm::io
