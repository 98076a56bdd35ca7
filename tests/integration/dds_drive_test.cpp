// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot on the network, as a process on loopback: it is driven.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "tests/support/network.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

/// Somebody with a joystick, who sees where the simulated robot is.
class Operator {
 public:
  Operator(const PrivateNetwork& network, const std::string& robot)
      : participant_({.interface = "lo", .tag = network.tag()}),
        commands_(participant_,
                  dds::RobotNames(robot).Topic(dds::kCommandTopic),
                  dds::Profile::kSensorOut),
        truth_(
            participant_, dds::RobotNames(robot).Topic(dds::kTruthTopic), dds::Profile::kSensorIn) {
  }

  /// Asks for that motion until the robot is where it is wanted. @returns false after 20 seconds.
  bool Drive(double forward_mps,
             double turn_rad_s,
             const std::function<bool(const dds::wire::Pose&)>& is_there) {
    for (int i = 0; i < 400; ++i) {
      commands_.Write({.linear = {forward_mps, 0.0, 0.0}, .angular = {0.0, 0.0, turn_rad_s}});
      std::this_thread::sleep_for(50ms);
      truth_.TakeAll([this](const dds::wire::Odometry& sample) { pose_ = sample.pose.pose; });
      if (pose_ && is_there(*pose_)) return true;
    }
    return false;
  }

 private:
  dds::Participant participant_;
  dds::Writer<dds::wire::Twist> commands_;
  dds::Reader<dds::wire::Odometry> truth_;
  std::optional<dds::wire::Pose> pose_;
};

class DdsDrive : public ::testing::Test {
 protected:
  std::filesystem::path Path(const char* name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(DdsDrive, SimulatedRobotGoesWhereItsOperatorWants) {
  std::ofstream(Path("hall.yaml")) << "scenery:\n"
                                      "  walls:\n"
                                      "    - {from_x_m: 9, from_y_m: -9, to_x_m: 9, to_y_m: 9}\n"
                                      "robots:\n"
                                      "  - name: robot1\n"
                                      "    driver: {kind: external}\n";
  Daemon simulator(network_.JoinSimulator(
      {"sim", Path("hall.yaml"), "--duration", "3600", "--dds", "--output", Path("drive")}));
  Operator joystick(network_, "robot1");
  const auto goes_ahead = [](const dds::wire::Pose& pose) { return pose.position.x > 0.3; };
  const auto has_turned = [](const dds::wire::Pose& pose) { return pose.orientation.z > 0.2; };
  EXPECT_TRUE(joystick.Drive(0.5, 0.0, goes_ahead)) << simulator.ErrorsSoFar();
  EXPECT_TRUE(joystick.Drive(0.0, 0.5, has_turned));
  // What is no number is passed over: the robot turns on.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(joystick.Drive(
      nan, nan, [](const dds::wire::Pose& pose) { return pose.orientation.z > 0.4; }));
  simulator.End(SIGINT);
}

}  // namespace
}  // namespace qwsm::test
