// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "service/io/rescue/points_of_interest.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/input_file.hpp"

/// Any bytes as a list of points of interest: never a crash, never an exception but one that names
/// the list and the line; what was read is read again from the list that is written of it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using qwsm::test::Expect;
  static const qwsm::test::InputFile kWritten("pois.csv");
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const auto points = qwsm::io::ReadPointsOfInterest(stream, "marks");
    qwsm::io::WritePointsOfInterest(kWritten.path(), {}, points);
    const auto again = qwsm::io::ReadPointsOfInterest(kWritten.path());
    Expect(again.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      Expect(again[i].id == points[i].id && again[i].text == points[i].text);
      Expect((again[i].p_map_m - points[i].p_map_m).cwiseAbs().maxCoeff() < 1e-3);
    }
  } catch (const std::runtime_error& error) {
    Expect(std::string_view(error.what()).starts_with("marks:"));
  }
  return 0;
}
