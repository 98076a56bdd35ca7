// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "qwsm/logs/log_reader.hpp"
#include "tests/support/bag_maker.hpp"
#include "tests/support/log_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;
using test::Ros;

constexpr int kScans = 120;
constexpr int kCuts = 200;
constexpr int kFlips = 500;

std::vector<float> Ranges(std::mt19937& random) {
  std::uniform_real_distribution<float> range_m(0.5F, 20.0F);
  std::vector<float> ranges_m(40);
  for (float& value_m : ranges_m) value_m = range_m(random);
  return ranges_m;
}

std::vector<test::MadeMessage> Drive(Ros ros) {
  std::mt19937 random(7);
  std::vector<test::MadeMessage> drive;
  for (int i = 0; i < kScans; ++i) {
    const Timestamp stamp = 1000s + i * 100ms;
    drive.push_back(test::OdometryMessageOf(ros, "/odom", stamp, "base", {0.1 * i, 0.0, 0.0}));
    drive.push_back(test::ScanMessage(ros, "/scan", stamp, "laser", Ranges(random)));
  }
  return drive;
}

/// The bytes of a bag of each kind.
std::string BagOf(const std::string& kind) {
  if (kind == "mcap") return test::McapOf(Drive(Ros::k2), "zstd", 12);
  if (kind == "lz4_mcap") return test::McapOf(Drive(Ros::k2), "lz4", 12);
  if (kind == "plain_mcap") return test::McapOf(Drive(Ros::k2), "", 12);
  if (kind == "bag") return test::Ros1BagOf(Drive(Ros::k1), "bz2", 12);
  if (kind == "plain_bag") return test::Ros1BagOf(Drive(Ros::k1), "none", 12);
  const test::TemporaryFolder folder;
  test::WriteDb3(folder.path() / "t.db3", Drive(Ros::k2), 4);
  return test::ReadBytes(folder.path() / "t.db3");
}

class DamagedBag : public testing::TestWithParam<const char*> {
 protected:
  /// Number of scans that could be read, 0 where it was refused. Anything but LogError fails.
  std::size_t ScansOf(const std::string& bytes) {
    test::WriteBytes(folder_.path() / "t", bytes);
    told_ = false;
    LogOptions options;
    options.on_fault = [this](const std::string&) { told_ = true; };
    try {
      return test::ReadAll(*OpenLog(folder_.path() / "t", options)).scans.size();
    } catch (const LogError& error) {
      EXPECT_NE(std::string(error.what()), "");
      told_ = true;
      return 0;
    }
  }

  test::TemporaryFolder folder_;
  bool told_ = false;
};

TEST_P(DamagedBag, GivesWhatStandsBeforeACut) {
  const std::string bytes = BagOf(GetParam());
  const bool is_sqlite = std::string(GetParam()) == "db3";
  for (int i = 1; i <= kCuts; ++i) {
    SCOPED_TRACE(i);
    const std::size_t size = bytes.size() * static_cast<std::size_t>(i) / (kCuts + 1);
    const std::size_t scans = ScansOf(bytes.substr(0, size));
    EXPECT_TRUE(told_);
    EXPECT_LE(scans, static_cast<std::size_t>(kScans));
    // All chunks but the one that was cut; the pages of a database are in no order.
    const double share = static_cast<double>(i) / (kCuts + 1);
    const double least = is_sqlite ? 0.0 : share * kScans - 8.0;
    EXPECT_GE(static_cast<double>(scans), least);
  }
}

TEST_P(DamagedBag, LosesLittleToAFlippedByte) {
  const std::string bytes = BagOf(GetParam());
  std::mt19937 random(42);
  std::size_t total = 0;
  for (int i = 0; i < kFlips; ++i) {
    std::string flipped = bytes;
    flipped[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
    const std::size_t scans = ScansOf(flipped);
    EXPECT_TRUE(told_ || scans == kScans) << "flip " << i << " leaves " << scans;
    total += scans;
  }
  EXPECT_GE(static_cast<double>(total), 0.93 * kFlips * kScans);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    DamagedBag,
    testing::Values("mcap", "lz4_mcap", "plain_mcap", "bag", "plain_bag", "db3"),
    [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace qwsm::io
