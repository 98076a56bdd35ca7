// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

#include "service/io/trajectories/relations_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using qwsm::test::Expect;
using namespace qwsm::io;

void FuzzTum(const std::string& bytes) {
  std::istringstream stream(bytes);
  const qwsm::Trajectory trajectory = ReadTum(stream, "fuzz");
  std::stringstream written;
  for (const qwsm::StampedPose2& pose : trajectory) {
    Expect(IsFinite(pose.T_map_robot));
    WriteTumLine(written, pose);
  }
  const qwsm::Trajectory copy = ReadTum(written, "copy");
  Expect(copy.size() == trajectory.size());
  for (std::size_t i = 0; i < copy.size(); ++i) {
    Expect(copy[i].stamp == trajectory[i].stamp);
    Expect(copy[i].T_map_robot.x_m == trajectory[i].T_map_robot.x_m);
  }
}

void FuzzRelations(const std::string& bytes) {
  std::istringstream stream(bytes);
  for (const qwsm::Relation& relation : ReadRelations(stream, "fuzz")) {
    Expect(IsFinite(relation.T_first_second));
  }
}

}  // namespace

/// Any bytes: never a crash, never an exception but the one that names file and line; trajectories
/// survive being written and read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const auto fuzz : {FuzzTum, FuzzRelations}) {
    try {
      fuzz(bytes);
    } catch (const std::runtime_error& error) {
      Expect(std::string(error.what()).starts_with("fuzz:"));
    }
  }
  return 0;
}
