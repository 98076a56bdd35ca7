// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm map` on a bag of several robots: they map as a team.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "service/config/options_io.hpp"
#include "service/io/bags/writing/bag_file.hpp"
#include "service/io/bags/writing/ros_encoding.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "sim/simulation.hpp"
#include "tests/support/program.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array kRobots{"robot_1", "robot_2"};

/// What two robots of an office see, where they are, and what their odometry says from its own
/// origin each.
std::vector<sim::Reading> Drive() {
  sim::Simulation simulation(config::LoadOptions<sim::ScenarioOptions>(
      {.file = QWSM_SOURCE_DIR "/configs/scenarios/team.yaml", .settings = {"duration_s=100"}}));
  std::vector<sim::Reading> readings;
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    if (reading->robot < kRobots.size()) readings.push_back(std::move(*reading));
  }
  return readings;
}

class TeamBag : public testing::Test {
 protected:
  void SetUp() override {
    io::BagFile bag(bag_, io::BagFormat::kMcap);
    for (const sim::Reading& reading : drive_) {
      const std::string robot = kRobots[reading.robot];
      const Timestamp stamp = reading.scan.stamp;
      bag.Write(
          {"/" + robot + "/odom", "nav_msgs/msg/Odometry"},
          stamp,
          io::EncodeOdometry(stamp, robot + "/odom", robot + "/base_link", reading.T_odom_robot));
      bag.Write(
          {"/tf_static", "tf2_msgs/msg/TFMessage", true},
          stamp,
          io::EncodeTransform(
              stamp, robot + "/base_link", robot + "/laser", reading.scan.geometry.T_robot_laser));
      bag.Write({"/" + robot + "/scan", "sensor_msgs/msg/LaserScan"},
                stamp,
                io::EncodeLaserScan(reading.scan, robot + "/laser"));
    }
    bag.Commit();
  }

  Outcome Map(const fs::path& results, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", bag_, "--output", results};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  }

  /// The last reading of a robot: where it is in the end.
  const sim::Reading& Last(std::size_t robot) const {
    return *std::find_if(drive_.rbegin(), drive_.rend(), [robot](const sim::Reading& reading) {
      return reading.robot == robot;
    });
  }

  TemporaryFolder folder_;
  fs::path bag_ = folder_.path() / "team.mcap";
  std::vector<sim::Reading> drive_ = Drive();
};

TEST_F(TeamBag, IsMappedIntoOneMapTheSameEachTime) {
  const fs::path first = folder_.path() / "first";
  const Outcome mapped = Map(first);
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  EXPECT_NE(mapped.output.find("robot_2"), std::string::npos) << mapped.output;
  EXPECT_TRUE(fs::exists(first / "map.png"));
  std::array<Pose2, kRobots.size()> T_map_robot;
  for (std::size_t i = 0; i < kRobots.size(); ++i) {
    const Trajectory path = io::ReadTumFile(first / kRobots[i] / "trajectory.tum");
    ASSERT_GT(path.size(), 50U) << kRobots[i] << mapped.errors;
    T_map_robot[i] = path.back().T_map_robot;
  }
  // The map is that of the first robot: what one is to the other tells whether they share it.
  const Pose2 found = T_map_robot[0].Inverse() * T_map_robot[1];
  const Pose2 truth = Last(0).T_world_robot.Inverse() * Last(1).T_world_robot;
  EXPECT_NEAR(found.x_m, truth.x_m, 0.1);
  EXPECT_NEAR(found.y_m, truth.y_m, 0.1);

  const fs::path second = folder_.path() / "second";
  ASSERT_EQ(Map(second, {"--save-map", folder_.path() / "team.qwsm"}).exit_code, 0);
  for (const char* robot : kRobots) {
    EXPECT_TRUE(ReadFile(first / robot / "trajectory.tum") ==
                ReadFile(second / robot / "trajectory.tum"))
        << robot;
  }
  EXPECT_TRUE(fs::exists(folder_.path() / "team.qwsm"));
}

TEST_F(TeamBag, GivesOneRobotWhereItIsAskedFor) {
  const fs::path results = folder_.path() / "one";
  ASSERT_EQ(Map(results, {"--robot", "robot_2"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(results / "trajectory.tum"));
  const Outcome refused = Map(results, {"--force", "--bag"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(
      refused.errors.find("holds several robots: /robot_1, /robot_2; choose one with --robot"),
      std::string::npos)
      << refused.errors;
}

}  // namespace
}  // namespace qwsm::test
