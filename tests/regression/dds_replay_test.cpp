// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Recorded logs through the network give what `qwsm map` gives, to the last bit: their stamps go
// back at times, their scans come from lasers that differ, and the map of aces is corrected on the
// way, too, not only in the end.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

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
  ExpectSamePath(Path("served"), Path("mapped"));
  ExpectSameMap(Path("served"), Path("mapped"));
}

INSTANTIATE_TEST_SUITE_P(Radish,
                         RecordedReplay,
                         ::testing::Values("intel.raw-odom.clf.gz",
                                           "aces.raw-odom.clf.gz",
                                           "belgioioso.raw-odom.clf.gz",
                                           "edmonton.raw-odom.clf.gz"));

}  // namespace
}  // namespace qwsm::test
