// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A service that works for long without a new thing to learn keeps its memory, also where its map
// is corrected again and again: `ctest -C soak`.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/team/scans/component.hpp"
#include "tests/support/moved_map.hpp"
#include "tests/support/process_state.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr int kFirstCorrections = 50;

/// How long; QWSM_SOAK_S for another time.
std::chrono::seconds Duration() {
  const char* text = std::getenv("QWSM_SOAK_S");
  return std::chrono::seconds(text == nullptr ? 600 : std::atoi(text));
}

struct Sample {
  double time_s = 0.0;
  double resident_kb = 0.0;
};

/// Slope of the line through the samples that has the least squares.
double KilobytesPerSecond(const std::vector<Sample>& samples) {
  double time_s = 0.0;
  double resident_kb = 0.0;
  for (const Sample& sample : samples) {
    time_s += sample.time_s / static_cast<double>(samples.size());
    resident_kb += sample.resident_kb / static_cast<double>(samples.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (const Sample& sample : samples) {
    covariance += (sample.time_s - time_s) * (sample.resident_kb - resident_kb);
    variance += (sample.time_s - time_s) * (sample.time_s - time_s);
  }
  return covariance / variance;
}

/// A service elsewhere that has mapped the room, and corrects all of that again and again.
class Elsewhere {
 public:
  static constexpr int kScans = 200;

  explicit Elsewhere(const dds::Participant& participant)
      : scan_writer_(participant, dds::kSharedScansTopic, dds::Profile::kSharedScans),
        epoch_writer_(
            participant, dds::RobotNames("").Topic(dds::kMapEpochTopic), dds::Profile::kLatched) {}

  void ShareRoom() {
    for (int i = 0; i < kScans; ++i) {
      const Observation observation = ObservationInRoom(3 * i);
      scans_.push_back(
          {.key = {.service = "elsewhere",
                   .robot = "scout",
                   .sequence = static_cast<std::uint64_t>(i) + 1},
           .scan = observation.scan,
           .map_robot = UncertainPose2::WithSigmas(*observation.T_odom_robot, 0.01, 0.001)});
      scan_writer_.Write(dds::ToWire(scans_.back(), team::FrameOf("")));
    }
  }
  /// Puts all scans a little elsewhere, there and back.
  void Correct() {
    ++corrections_;
    const team::TeamEpoch epoch = Moved(scans_,
                                        {.x_m = corrections_ % 2 == 1 ? 0.003 : -0.003},
                                        {.number = corrections_, .service = "elsewhere"});
    epoch_writer_.Write(dds::EpochSample(epoch).sample());
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      scans_[i].map_robot = epoch.scans[i].map_robot;
    }
  }

 private:
  dds::Writer<dds::wire::RelevantScan> scan_writer_;
  dds::Writer<dds::wire::MapEpoch> epoch_writer_;
  std::vector<team::TeamScan> scans_;
  std::uint64_t corrections_ = 0;
};

TEST(DdsSoak, MemoryStaysFlat) {
  const TemporaryFolder folder;
  const PrivateNetwork network;
  RobotInRoom robot(network);
  // The map grows with relevant scans, as it must: here are none once the room is known.
  Daemon service(network.Join({"serve",
                               "--verbose",
                               "--journal",
                               folder.path() / "team.db",
                               "--set",
                               "mapper.relevant_translation_m=100",
                               "--set",
                               "mapper.relevant_rotation_deg=180",
                               "--set",
                               "team.map_period_s=1",
                               "--set",
                               "team.status_period_s=0.2"}));
  Elsewhere elsewhere(robot.participant());
  elsewhere.ShareRoom();
  ASSERT_TRUE(robot.DriveUntil("qwsm: service", "map_scans", [](const std::string& scans) {
    return std::stoi(scans) >= Elsewhere::kScans;
  }));
  robot.Tell(UncertainPose2::WithSigmas(robot.T_map_robot(), 0.1, 0.02));
  ASSERT_FALSE(robot.DriveUntilAnswered(300).empty());
  // Each correction touches all that holds a map; after so many there is nothing left to fill.
  for (int i = 0; i < kFirstCorrections; ++i) {
    elsewhere.Correct();
    ASSERT_FALSE(robot.DriveUntilAnswered(10).empty());
  }
  std::vector<Sample> samples;
  std::size_t reports = 0;
  int corrections = 0;
  const auto begun = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begun < Duration()) {
    for (int i = 0; i < 20; ++i) reports += robot.Drive(25ms).size();
    robot.HealthOf("qwsm: service");
    robot.TakeSharedScans();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begun;
    if (10.0 * time > (corrections + 1.0) * Duration()) {
      ++corrections;
      elsewhere.Correct();
    }
    if (time < Duration() / 6) continue;  // Buffers and caches fill.
    samples.push_back({time.count(), ResidentKilobytes(service.process())});
  }
  const std::string scans = robot.HealthOf("qwsm: service")["map_scans"];
  const std::string corrected = robot.HealthOf("qwsm: service")["map_corrections"];
  ASSERT_EQ(service.End().exit_code, 0);
  ASSERT_GT(samples.size(), 2U);
  const double growth_kb =
      KilobytesPerSecond(samples) * (samples.back().time_s - samples.front().time_s);
  std::cout << reports << " scans in " << Duration().count() << " s, " << scans
            << " in the map, which was corrected " << corrected << " times; memory "
            << samples.back().resident_kb << " kB, grown by " << growth_kb << " kB\n";
  EXPECT_GT(reports, 0U);
  EXPECT_GE(corrections, 9);
  EXPECT_GE(std::stoi(corrected), kFirstCorrections + 9);
  EXPECT_LT(growth_kb, 0.02 * samples.back().resident_kb);
}

}  // namespace
}  // namespace qwsm::test
