// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Recorded logs through the network give what `qwsm map` gives, to the last bit: their stamps go
// back at times, their scans come from lasers that differ, and the map of aces is corrected on the
// way.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/network.hpp"
#include "tests/support/replay.hpp"

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
  ASSERT_NO_FATAL_FAILURE(MapOverNetworkAndFromFile(network_, Log(), folder_.path()));
  const std::array<std::pair<const char*, const char*>, 2> twins{
      {{"trajectory.tum", "trajectory_live.tum"}, {"map.png", "map_live.png"}}};
  for (const auto& [served, mapped] : twins) {
    const std::string expected = ReadFile(Path("mapped") + "/" + mapped);
    ASSERT_FALSE(expected.empty()) << mapped;
    EXPECT_TRUE(ReadFile(Path("served") + "/" + served) == expected) << served;
  }
}

INSTANTIATE_TEST_SUITE_P(Radish,
                         RecordedReplay,
                         ::testing::Values("intel.raw-odom.clf.gz",
                                           "aces.raw-odom.clf.gz",
                                           "belgioioso.raw-odom.clf.gz",
                                           "edmonton.raw-odom.clf.gz"));

}  // namespace
}  // namespace qwsm::test
