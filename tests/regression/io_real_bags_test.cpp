// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/bags/containers/bag_files.hpp"
#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

/// A bag of another's making, and what its description or metadata say of it.
struct KnownBag {
  const char* path;
  std::size_t messages;
  std::size_t scans = 0;
};

class RealBag : public testing::TestWithParam<KnownBag> {
 protected:
  void SetUp() override {
    path_ = std::filesystem::path(QWSM_DATA_DIR) / "bags" / GetParam().path;
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << path_ << " is not here";
  }

  std::filesystem::path path_;
};

TEST_P(RealBag, IsReadToItsLastMessage) {
  LogOptions options;
  options.strict = true;
  const test::LogContent log = test::ReadAll(*OpenLog(path_, options));
  EXPECT_EQ(log.report.lines, GetParam().messages);
  EXPECT_EQ(log.scans.size(), GetParam().scans);
  EXPECT_TRUE(log.report.faults.empty());
  EXPECT_EQ(log.report.lines, ReadMetadata(path_).messages.value_or(GetParam().messages));
  for (const ScanReading& reading : log.scans) EXPECT_GT(reading.scan.size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(All,
                         RealBag,
                         testing::Values(KnownBag{"test_turtlebot.bag", 3008, 819},
                                         KnownBag{"test_replay_crash.bag", 2418, 136},
                                         KnownBag{"rosbag2/sqlite3/talker", 20},
                                         KnownBag{"rosbag2/sqlite3/wbag", 6074},
                                         KnownBag{"rosbag2/mcap/talker", 20},
                                         KnownBag{"rosbag2/mcap/wbag", 6074},
                                         KnownBag{"rosbag2/topics_and_services.db3", 13},
                                         KnownBag{"rosbag2/topics_and_services.mcap", 13}),
                         [](const auto& tested) { return "Bag" + std::to_string(tested.index); });

}  // namespace
}  // namespace qwsm::io
