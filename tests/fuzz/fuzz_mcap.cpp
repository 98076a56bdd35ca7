// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/read_bag.hpp"

/// Any bytes behind the magic of MCAP.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const qwsm::test::InputFile file("fuzz");
  file.Write("\x89MCAP0\r\n" + std::string(reinterpret_cast<const char*>(data), size));
  qwsm::test::ReadBag(file, false);
  qwsm::test::ReadBag(file, true);
  return 0;
}
