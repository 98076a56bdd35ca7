// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "service/io/maps/ros_map_file.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/input_file.hpp"

namespace {

using qwsm::test::Expect;
using qwsm::test::InputFile;

constexpr std::string_view kEndOfHeader = "\n---picture---\n";

}  // namespace

/// Any bytes as the YAML of a map and, behind a line that says so, as its picture map.pgm: never a
/// crash, never an exception but one that names the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const InputFile kHeader("map.yaml");
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find(kEndOfHeader);
  kHeader.Write(std::string_view(bytes).substr(0, end));
  if (end != std::string::npos) {
    std::ofstream(kHeader.path().parent_path() / "map.pgm", std::ios::binary)
        << std::string_view(bytes).substr(end + kEndOfHeader.size());
  }
  try {
    const qwsm::OccupancyGrid grid = qwsm::io::ReadRosMap(kHeader.path());
    Expect(grid.cell_m > 0.0 && grid.width > 0 && grid.height > 0);
    Expect(grid.cells.size() ==
           static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  } catch (const std::runtime_error& error) {
    // The picture may be anywhere: its path begins at the root as that of the header does.
    Expect(std::string_view(error.what()).starts_with('/'));
  }
  return 0;
}
