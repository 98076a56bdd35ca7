// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/mapping/mapper.hpp"
#include "service/io/bags/writing/log_bag_writer.hpp"
#include "service/pipeline/run/thread_time.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

constexpr std::uintmax_t kGigabyte = 1'000'000'000;
constexpr std::size_t kBeams = 10'000;

/// The most memory this program ever had, in bytes.
std::size_t PeakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// Writes a gigabyte of scans that cannot be compressed. @return how many
std::size_t WriteGigabyte(const std::filesystem::path& path) {
  BagFile bag(path, *BagFormatOf(path));
  LogBagWriter writer(bag);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> range_m(0.5F, 29.0F);
  std::vector<float> noise_m(2 * kBeams);
  for (float& value_m : noise_m) value_m = range_m(random);
  const std::size_t scans = kGigabyte / (kBeams * sizeof(float));
  for (std::size_t i = 0; i < scans; ++i) {
    const auto begin = noise_m.begin() + static_cast<std::ptrdiff_t>(random() % kBeams);
    LaserScan scan{
        .stamp = 1000s + static_cast<std::int64_t>(i) * 25ms, .geometry = {}, .ranges_m = {}};
    scan.geometry.bearing_step_rad = 0.0006F;
    scan.geometry.range_max_m = 30.0F;
    scan.ranges_m.assign(begin, begin + kBeams);
    writer.Write(ScanReading{.scan = std::move(scan), .T_odom_robot = Pose2{}, .laser = "front"});
  }
  bag.Commit();
  return scans;
}

/// A drive with scans as robots have them, and odometry.
void WriteDrive(const std::filesystem::path& path) {
  const test::SimulatedDrive drive = test::DriveThrough(test::OfficeLoop(), {.scan_period_s = 0.1});
  BagFile bag(path, *BagFormatOf(path));
  LogBagWriter writer(bag);
  for (const Observation& observation : drive.observations) {
    writer.Write(ScanReading{
        .scan = observation.scan, .T_odom_robot = observation.T_odom_robot, .laser = "front"});
  }
  bag.Commit();
}

class LargeBag : public testing::TestWithParam<const char*> {};

TEST_P(LargeBag, OfAGigabyteIsReadInLittleMemory) {
  const test::TemporaryFolder folder;
  if (std::filesystem::space(folder.path()).available < 3 * kGigabyte) {
    GTEST_SKIP() << "there is too little room in " << folder.path();
  }
  const std::filesystem::path path = folder.path() / GetParam();
  const std::size_t scans = WriteGigabyte(path);
  const auto reader = OpenLog(path);
  while (reader->Next()) {
  }
  EXPECT_EQ(reader->report().scans, scans);
  EXPECT_LE(PeakMemory(), 200U << 20U);
}

INSTANTIATE_TEST_SUITE_P(All,
                         LargeBag,
                         testing::Values("large.mcap", "large.db3"),
                         [](const auto& tested) { return "Bag" + std::to_string(tested.index); });

/// Processor time that something takes, the least of a few rounds: in the first one the kernel hands
/// out memory, which takes as long as it likes.
template <class Work>
std::chrono::duration<double> TimeOf(Work work) {
  constexpr int kRounds = 3;
  auto least = std::chrono::duration<double>::max();
  for (int round = 0; round < kRounds; ++round) {
    const auto before = pipeline::WorkedByThread();
    work();
    least = std::min<std::chrono::duration<double>>(least, pipeline::WorkedByThread() - before);
  }
  return least;
}

TEST(LargeBagOfScans, IsReadTenTimesAsFastAsItIsMapped) {
  const test::TemporaryFolder folder;
  for (const char* name : {"drive.mcap", "drive.db3"}) {
    const std::filesystem::path path = folder.path() / name;
    WriteDrive(path);
    std::vector<Observation> observations;
    const auto reading = TimeOf([&] {
      observations.clear();
      const auto reader = OpenLog(path);
      while (std::optional<LogRecord> record = reader->Next()) {
        if (auto* scan = std::get_if<ScanReading>(&*record)) {
          observations.push_back({std::move(scan->scan), scan->T_odom_robot});
        }
      }
    });
    const auto mapping = TimeOf([&] {
      Mapper mapper;
      for (const Observation& observation : observations) mapper.Process(observation);
    });
    RecordProperty(name, std::to_string(mapping / reading));
    EXPECT_GE(mapping / reading, 10.0) << name;
  }
}

}  // namespace
}  // namespace qwsm::io
