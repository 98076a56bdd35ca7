// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Messages that come twice, out of order, late, not at all, by a clock that was set, or too many of
// them: the service, a process on loopback, counts them, says so, and matches those that follow.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 5ms;

/// Drives by a clock that is off by so much.
void DriveBy(RobotInRoom& robot, std::chrono::nanoseconds offset, int scans) {
  for (int i = 0; i < scans; ++i) {
    Observation observation = robot.NextObservation();
    observation.scan.stamp += offset;
    robot.Publish(observation);
    robot.Hear(kPause);
  }
}

/// Every scan twice; then every other one before the one it follows; then one of five.
void DriveInDisorder(RobotInRoom& robot) {
  for (int i = 0; i < 20; ++i) {
    const Observation observation = robot.NextObservation();
    robot.Publish(observation);
    robot.Publish(observation);
    robot.Hear(kPause);
  }
  for (int i = 0; i < 20; ++i) {
    const Observation first = robot.NextObservation();
    robot.Publish(robot.NextObservation());
    robot.Publish(first);
    robot.Hear(kPause);
  }
  for (int i = 0; i < 20; ++i) {
    for (int lost = 0; lost < 4; ++lost) robot.NextObservation();
    robot.Drive(kPause);
  }
}

class DdsDisorder : public ::testing::Test {
 protected:
  std::vector<std::string> Serve(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"serve", "--verbose", "--set", "team.status_period_s=0.2"});
    return network_.Join(more);
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(DdsDisorder, IsCountedAndToldAndWhatFollowsIsMatched) {
  RobotInRoom robot(network_);
  Daemon service(Serve());
  ASSERT_GE(robot.DriveUntilAnswered(20).size(), 20U);
  DriveInDisorder(robot);
  constexpr auto kDay = std::chrono::hours(24);
  DriveBy(robot, kDay, 40);
  DriveBy(robot, 0s, 40);     // The clock was set back,
  DriveBy(robot, -kDay, 40);  // and again to before the beginning: these stamps are no time.
  DriveBy(robot, 0s, 10);

  const auto some = [](const std::string& count) { return std::stoi(count) > 0; };
  EXPECT_TRUE(robot.DriveUntil("qwsm: robot1", "duplicates", some));
  EXPECT_TRUE(robot.DriveUntil("qwsm: robot1", "late", some));
  EXPECT_TRUE(robot.DriveUntil("qwsm: robot1", "clock_resets", some));
  robot.Hear(200ms);
  const std::vector<dds::MatchReport> last = robot.DriveUntilAnswered(10);
  ASSERT_GE(last.size(), 10U);
  for (const dds::MatchReport& report : last) {
    EXPECT_NE(report.status, StepStatus::kDeadReckoned) << report.reason;
  }
  EXPECT_EQ(service.End().exit_code, 0);
}

// A frame has one parent, or who follows transforms finds no way.
TEST_F(DdsDisorder, AGapInOdometryHangsTheRobotOnNoOtherFrame) {
  RobotInRoom robot(network_);
  const dds::Reader<dds::wire::TFMessage> transforms(
      robot.participant(), dds::kTransformsTopic, dds::Profile::kAnswerIn);
  Daemon service(Serve());
  ASSERT_GE(robot.DriveUntilAnswered(20).size(), 20U);
  constexpr std::size_t kGap = 8;
  std::size_t answered_in_gap = 0;
  for (std::size_t i = 0; i < kGap; ++i) {
    Observation observation = robot.NextObservation();
    observation.T_odom_robot.reset();
    robot.Publish(observation);
    for (int wait = 0; wait < 100 && answered_in_gap <= i; ++wait) {
      answered_in_gap += robot.Hear(10ms).size();
    }
  }
  EXPECT_GE(answered_in_gap, kGap);
  EXPECT_TRUE(robot.DriveUntilAllAreAnswered(20));
  std::set<std::pair<std::string, std::string>> parents;
  transforms.TakeAll([&](const dds::wire::TFMessage& sample) {
    for (std::uint32_t i = 0; i < sample.transforms._length; ++i) {
      const dds::wire::TransformStamped& one = sample.transforms._buffer[i];
      parents.emplace(one.child_frame_id, one.header.frame_id);
    }
  });
  const decltype(parents) one_each{{"robot1/base_link", "robot1/odom"}, {"robot1/odom", "map"}};
  EXPECT_EQ(parents, one_each);
  const Outcome served = service.End();
  EXPECT_EQ(served.output.find(" 0 without odometry"), std::string::npos) << served.output;
}

/// `N of M scans answered` at the end of a service.
std::pair<double, double> AnsweredOf(const Outcome& served) {
  const std::size_t at = served.output.find("robot1 ");
  int answered = 0;
  int scans = 0;
  if (at != std::string::npos) {
    sscanf(served.output.c_str() + at, "robot1 %d of %d", &answered, &scans);
  }
  return {answered, scans};
}

/// How long the service takes to stop.
std::chrono::duration<double> TimeToStop(Daemon& service, Outcome& served) {
  const auto begun = std::chrono::steady_clock::now();
  served = service.End(SIGTERM);
  EXPECT_EQ(served.exit_code, 0) << served.errors;
  return std::chrono::steady_clock::now() - begun;
}

TEST_F(DdsDisorder, ServiceThatIsToldToStopSavesAllButDoesNotFinishItsQueue) {
  const std::filesystem::path journal = folder_.path() / "team.db";
  const std::filesystem::path results = folder_.path() / "served";
  RobotInRoom robot(network_);
  const auto serve = [&](const std::filesystem::path& output) {
    return Serve(
        {"--set", "team.session.queue_scans=100000", "--journal", journal, "--output", output});
  };
  Daemon service(serve(results));
  robot.DriveUntilAnswered(1);
  const auto begun = std::chrono::steady_clock::now();
  Observation observation = robot.NextObservation();
  for (int i = 0; i < 5000; ++i) {
    observation.scan.stamp += 100ms;
    robot.Publish(observation);
  }
  const std::chrono::duration<double> working = std::chrono::steady_clock::now() - begun;
  Outcome served;
  const std::chrono::duration<double> stopping = TimeToStop(service, served);
  const auto [answered, scans] = AnsweredOf(served);
  ASSERT_GT(answered, 0.0) << served.output;

  std::set<Timestamp> stored;
  io::JournalFile file = io::JournalFile::Read(journal, io::kScanJournal);
  while (const auto entry = file.Next()) stored.insert(entry->stamp);
  for (const dds::MatchReport& report : robot.Hear(50ms)) {
    EXPECT_TRUE(!report.relevant || stored.contains(report.stamp));
  }
  EXPECT_TRUE(std::filesystem::exists(results / "map.pgm"));
  EXPECT_TRUE(std::filesystem::exists(results / "robot1" / "trajectory.tum"));

  // The yardsticks: a service with the same map and nothing to do, and all that was left out.
  Daemon idle(serve(folder_.path() / "idle"));
  ASSERT_TRUE(idle.WaitUntilItSays("serving as"));
  const std::chrono::duration<double> idle_stopping = TimeToStop(idle, served);
  const std::chrono::duration<double> left_out = (scans - answered) / answered * working;
  std::cout << answered << " of " << scans << " answered in " << working.count()
            << " s; stopped in " << stopping.count() << " s, idle in " << idle_stopping.count()
            << " s\n";
  EXPECT_LT(stopping, 5 * idle_stopping + left_out / 2);
}

}  // namespace
}  // namespace qwsm::test
