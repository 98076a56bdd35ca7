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
std::string WithHeader(std::uint32_t version, const std::string& rest) {
  boost::crc_32_type crc;
  crc.process_bytes(rest.data(), rest.size());
  BinaryWriter header;
  header.Add(version);
  header.Add(static_cast<std::uint32_t>(crc.checksum()));
  header.Add(static_cast<std::uint64_t>(rest.size()));
  return "QWSM map" + header.bytes() + rest;
}

void Decode(const std::string& bytes) {
  try {
    const auto again = [](const std::string& of, const char* name) {
      return EncodeMap(DecodeMap(of, name), DecodeMarksOfMap(of, name));
    };
    const std::string encoded = again(bytes, "fuzz");
    qwsm::test::Expect(again(encoded, "copy") == encoded);
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
  Decode(WithHeader(1, bytes));
  Decode(WithHeader(2, bytes));
  return 0;
}
