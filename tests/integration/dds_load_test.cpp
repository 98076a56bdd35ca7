// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How the service bears more robots than one, and more than it can bear; bench/team_load is the
// long run with figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/network.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/team_traffic.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kQueueScans = 4;  // SessionOptions::queue_scans.

class DdsLoad : public ::testing::Test {
 protected:
  dds::NetworkOptions Network() const { return {.interface = "lo", .tag = network_.tag()}; }

  PrivateNetwork network_;
};

// On a machine that is busy with something else, or under a sanitizer, more slowly: what counts is
// that nothing is lost.
TEST_F(DdsLoad, SixteenRobotsAreAllAnswered) {
  constexpr int kRobots = 16;
  TeamTraffic team({.robots = kRobots, .rate_hz = 10.0, .duration_s = 4.0});
  Daemon service(network_.Join({"serve"}));
  ASSERT_TRUE(team.Join(Network()));
  const TrafficResult calm = team.Run(4 * kRobots, 0.2);
  ASSERT_EQ(calm.answered, calm.sent) << service.End().output;
  const std::chrono::duration<double> match = Quantile(calm.matching, 0.9);
  const double speed = std::min(0.5, 0.5 / (match.count() * kRobots * 10.0));

  const TrafficResult result = team.Run(team.scans_left(), speed);
  EXPECT_EQ(result.counted, calm.sent + result.sent);
  EXPECT_EQ(result.answered, result.sent);
  EXPECT_EQ(result.dropped, 0U);
  EXPECT_EQ(result.out_of_order, 0U);
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0);
  if (HasFailure()) std::cout << served.output;
}

TEST_F(DdsLoad, FourTimesTooMuchCostsTheOldestScansAndBoundsTheLatency) {
  constexpr int kRobots = 4;
  // Of so many beams a scan takes much longer to match than to send: the sender can send too much.
  TeamTraffic team({.robots = kRobots, .beams = 2881, .rate_hz = 50.0, .duration_s = 10.0});
  Daemon service(network_.Join({"serve", "--set", "team.threads=1"}));
  ASSERT_TRUE(team.Join(Network()));
  const TrafficResult calm = team.Run(400, 0.5);
  ASSERT_GT(calm.answered, 0U);
  const std::chrono::duration<double> match = Quantile(calm.matching, 0.5);
  const double speed = 4.0 / (match.count() * kRobots * 50.0);

  const TrafficResult result = team.Run(team.scans_left(), speed);
  RecordProperty("speed", std::to_string(speed));
  ASSERT_GT(result.answered, 0U);
  EXPECT_GT(result.dropped, result.answered);
  EXPECT_EQ(result.out_of_order, 0U);  // The oldest go, never the newer ones.
  // Every scan was answered or dropped, but for those of which no later report tells.
  EXPECT_NEAR(static_cast<double>(calm.answered + result.answered + result.dropped),
              static_cast<double>(result.counted),
              kRobots * (kQueueScans + 1));
  // What is answered has waited for no more than what was in all queues.
  EXPECT_LT(Quantile(result.latency, 0.9),
            3 * kRobots * (kQueueScans + 1) * Quantile(result.matching, 0.9));
  EXPECT_EQ(service.End().exit_code, 0);
}

/// Robots in the room of RobotInRoom whose lasers have as many beams as a scan may have.
class HeavyRobots {
 public:
  explicit HeavyRobots(const dds::Participant& participant) {
    for (const std::string name : {"heavy1", "heavy2"}) {
      publishers_.push_back(std::make_unique<dds::RobotPublisher>(
          participant, dds::RobotNames(name), dds::OdometryUse::kPublished));
    }
  }

  bool Join(const Pose2& T_map_robot) const {
    return std::ranges::all_of(publishers_, [&](const auto& publisher) {
      if (!publisher->WaitForListener({}, 10s)) return false;
      publisher->TellPose({}, UncertainPose2::WithSigmas(T_map_robot, 0.1, 0.05));
      return true;
    });
  }
  void Publish(Observation observation) const {
    const std::vector<float> ranges_m = std::exchange(observation.scan.ranges_m, {});
    const std::size_t finer = kMaxBeams / ranges_m.size();
    for (const float range_m : ranges_m) {
      observation.scan.ranges_m.insert(observation.scan.ranges_m.end(), finer, range_m);
    }
    observation.scan.geometry.bearing_step_rad /= static_cast<float>(finer);
    for (const auto& publisher : publishers_) publisher->Publish(observation);
  }

 private:
  static constexpr std::size_t kMaxBeams = 100'000;
  std::vector<std::unique_ptr<dds::RobotPublisher>> publishers_;
};

TEST_F(DdsLoad, HeavyRobotsCostTheOthersNoAnswers) {
  constexpr std::size_t kScans = 60;
  Daemon service(network_.Join({"serve"}));
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(1).empty());
  const HeavyRobots heavy(robot.participant());
  ASSERT_TRUE(heavy.Join(*robot.NextObservation().T_odom_robot));
  dds::MatchReportReader heavy_reports(robot.participant(), {"heavy1", "heavy2"});
  std::size_t answered = 0;
  for (std::size_t scan = 0; scan < kScans; ++scan) {
    const auto next = std::chrono::steady_clock::now() + 100ms;
    const Observation observation = robot.NextObservation();
    heavy.Publish(observation);
    robot.Publish(observation);
    answered += robot
                    .Hear(std::chrono::ceil<std::chrono::milliseconds>(
                        next - std::chrono::steady_clock::now()))
                    .size();
  }
  answered += robot.Hear(500ms).size();
  const std::size_t heavy_answered = heavy_reports.Take(0ms).size();
  std::cout << answered << " of " << kScans << ", " << heavy_answered << " of " << 2 * kScans
            << " heavy ones\n";
  EXPECT_GE(answered, kScans - 3);
  EXPECT_GE(heavy_answered, kScans);
  const std::string told = service.End().errors;
  EXPECT_NE(told.find("one in 20 is used"), std::string::npos) << told;
}

}  // namespace
}  // namespace qwsm::test
