// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Recorded logs through the network give what `qwsm map` gives, to the last bit: their stamps go
// back at times, and their scans come from lasers that differ.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/network.hpp"

namespace qwsm::test {
namespace {

class RecordedReplay : public ::testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path Log() const {
    return std::filesystem::path(QWSM_DATA_DIR) / "radish" / GetParam();
  }
  std::string Path(const char* name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_P(RecordedReplay, GivesThePathAndTheMapOfTheLogBitForBit) {
  if (!std::filesystem::exists(Log())) GTEST_SKIP() << Log() << " is not here";
  Daemon service(network_.JoinService({"serve", "--output", Path("served")}));
  const Outcome replay = network_.Run({"replay", Log(), "--rate", "max"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;

  const Outcome mapped = RunProgram({"map", Log(), "--output", Path("mapped")});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  for (const char* file : {"trajectory.tum", "map.pgm", "map.yaml"}) {
    const std::string expected = ReadFile(Path("mapped") + "/" + file);
    ASSERT_FALSE(expected.empty()) << file;
    EXPECT_TRUE(ReadFile(Path("served") + "/" + file) == expected) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Radish,
                         RecordedReplay,
                         ::testing::Values("intel.raw-odom.clf.gz",
                                           "belgioioso.raw-odom.clf.gz",
                                           "edmonton.raw-odom.clf.gz"));

}  // namespace
}  // namespace qwsm::test
