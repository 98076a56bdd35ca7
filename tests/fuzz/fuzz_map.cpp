// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>
#include <string>

#include "service/io/files/binary.hpp"
#include "service/io/maps/map_file.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace qwsm::io;

/// The bytes behind a header that is right, so that the search gets past the checksum.
std::string WithHeader(const std::string& rest) {
  boost::crc_32_type crc;
  crc.process_bytes(rest.data(), rest.size());
  BinaryWriter header;
  header.Add(std::uint32_t{1});
  header.Add(static_cast<std::uint32_t>(crc.checksum()));
  header.Add(static_cast<std::uint64_t>(rest.size()));
  return "QWSM map" + header.bytes() + rest;
}

void Decode(const std::string& bytes) {
  try {
    const std::string encoded = EncodeMap(DecodeMap(bytes, "fuzz"));
    qwsm::test::Expect(EncodeMap(DecodeMap(encoded, "copy")) == encoded);
  } catch (const MapFileError& error) {
    qwsm::test::Expect(std::string(error.what()).starts_with("fuzz: "));
  }
}

}  // namespace

/// Any bytes, as a file and as the contents of one: never a crash, never an exception but
/// MapFileError; and what is accepted is saved and loaded unchanged.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  Decode(bytes);
  Decode(WithHeader(bytes));
  return 0;
}
