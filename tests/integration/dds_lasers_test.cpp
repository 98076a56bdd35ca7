// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Robots with several lasers: the service, a process on loopback, hears them on one topic or on
// several, and answers each scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/transform_sample.hpp"
#include "tests/support/replay.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/two_lasers.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr Pose2 kRear{.x_m = 0.0, .y_m = 0.0, .theta_rad = 0.5};

/// What the laser of an observation sees, as told by one that is turned as the rear one is.
LaserScan SeenFromRear(const Observation& observation) {
  LaserScan scan = observation.scan;
  scan.geometry.first_bearing_rad -= static_cast<float>(kRear.theta_rad);
  return scan;
}

class DdsLasers : public ::testing::Test {
 protected:
  std::string Path(const char* name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(DdsLasers, AreHeardOnTopicsOfTheirOwn) {
  RobotInRoom robot(network_);
  const dds::Writer<dds::wire::TFMessage> mountings(
      robot.participant(), dds::kStaticTransformsTopic, dds::Profile::kStaticTransformsOut);
  const dds::Writer<dds::wire::LaserScan> rear(
      robot.participant(), "/robot1/rear/scan", dds::Profile::kSensorOut);
  const std::string frame = "robot1/rear";
  mountings.Write(dds::TransformSample({}, "robot1/base_link", frame, dds::ToWire(kRear)).sample());

  Daemon service(network_.JoinService({"serve", "--set", "team.scans=scan,rear/scan"}));
  std::map<Timestamp, int> answers;
  const auto hear = [&](std::chrono::milliseconds period) {
    const std::vector<dds::MatchReport> heard = robot.Hear(period);
    for (const dds::MatchReport& report : heard) ++answers[report.stamp];
    return !heard.empty();
  };
  const auto publish_pair = [&] {
    const Observation observation = robot.NextObservation();
    rear.Write(dds::ToWire(SeenFromRear(observation), frame));
    robot.Publish(observation);
    return observation.scan.stamp;
  };
  bool is_heard = false;  // On both topics.
  for (int i = 0; i < 4000 && !is_heard; ++i) {
    publish_pair();
    hear(5ms);
    is_heard = std::ranges::any_of(answers, [](const auto& answer) { return answer.second == 2; });
  }
  ASSERT_TRUE(is_heard);
  while (hear(300ms)) {
  }
  for (int i = 0; i < 40; ++i) {
    const int& answered = answers[publish_pair()];
    for (int k = 0; k < 1000 && answered < 2; ++k) hear(5ms);
    ASSERT_EQ(answered, 2) << "scans of one stamp are of two lasers";
  }
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0);
  EXPECT_EQ(served.output.find("rear"), std::string::npos) << "is no robot: " << served.output;
}

TEST_F(DdsLasers, OfALogGiveItsPathBitForBit) {
  std::ofstream(Path("two.yaml")) << kTwoLasers;
  const Outcome simulated =
      RunProgram({"sim", Path("two.yaml"), "--duration", "20", "--output", Path("drive")});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.errors;
  ASSERT_NO_FATAL_FAILURE(
      MapOverNetworkAndFromFile(network_, Path("drive/robot.log"), folder_.path()));
  ExpectSamePath(Path("served"), Path("mapped"));
}

TEST_F(DdsLasers, TellWhoListensLateWhereAllOfThemSit) {
  RobotInRoom robot(network_);
  Observation observation = robot.NextObservation();
  robot.Publish(observation);
  observation.scan.geometry.T_robot_laser = kRear;
  robot.Publish(observation);

  const dds::Reader<dds::wire::TFMessage> late(
      robot.participant(), dds::kStaticTransformsTopic, dds::Profile::kStaticTransforms);
  std::size_t told = 0;
  for (int i = 0; i < 1000 && told == 0; ++i) {
    std::this_thread::sleep_for(10ms);
    late.TakeAll([&](const dds::wire::TFMessage& sample) { told += sample.transforms._length; });
  }
  EXPECT_EQ(told, 2U);
}

TEST_F(DdsLasers, TopicsThatAreNoneAreRefused) {
  const Outcome served = network_.Run({"serve", "--set", "team.scans=scan,/rear"});
  EXPECT_EQ(served.exit_code, 2);
  EXPECT_NE(served.errors.find("team.scans: must be names below a robot's namespace"),
            std::string::npos)
      << served.errors;
}

}  // namespace
}  // namespace qwsm::test
