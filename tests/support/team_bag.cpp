// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/team_bag.hpp"

#include <optional>
#include <utility>

#include "service/io/bags/writing/bag_file.hpp"
#include "service/io/bags/writing/ros_encoding.hpp"

namespace qwsm::test {

std::vector<sim::Reading> ReadingsOf(const sim::ScenarioOptions& scenario, std::size_t robots) {
  sim::Simulation simulation(scenario);
  std::vector<sim::Reading> readings;
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    if (reading->robot < robots) readings.push_back(std::move(*reading));
  }
  return readings;
}

namespace {

/// The namespace of one robot in a bag.
class RobotTopics {
 public:
  RobotTopics(io::BagFile& bag, std::string name) : bag_(bag), name_(std::move(name)) {}

  void WriteOdometry(Timestamp stamp, const Pose2& T_odom_robot) {
    bag_.Write({"/" + name_ + "/odom", "nav_msgs/msg/Odometry"},
               stamp,
               io::EncodeOdometry(stamp, name_ + "/odom", base(), T_odom_robot));
  }
  void WriteTruth(Timestamp stamp, const Pose2& T_world_robot) {
    bag_.Write({"/" + name_ + "/ground_truth", "nav_msgs/msg/Odometry"},
               stamp,
               io::EncodeOdometry(stamp, "world", base(), T_world_robot));
  }
  void WriteImu(const ImuReading& imu) {
    bag_.Write(
        {"/" + name_ + "/imu", "sensor_msgs/msg/Imu"}, imu.stamp, io::EncodeImu(imu, base()));
  }
  void WriteScan(const LaserScan& scan) {
    const std::string laser = name_ + "/laser";
    bag_.Write({"/tf_static", "tf2_msgs/msg/TFMessage", true},
               scan.stamp,
               io::EncodeTransform(scan.stamp, base(), laser, scan.geometry.T_robot_laser));
    bag_.Write({"/" + name_ + "/scan", "sensor_msgs/msg/LaserScan"},
               scan.stamp,
               io::EncodeLaserScan(scan, laser));
  }

 private:
  std::string base() const { return name_ + "/base_link"; }

  io::BagFile& bag_;
  std::string name_;
};

}  // namespace

void WriteTeamBag(std::span<const sim::Reading> readings,
                  std::span<const std::string> names,
                  const std::filesystem::path& bag,
                  OdometryOfBag odometry) {
  io::BagFile file(bag, io::BagFormat::kMcap);
  for (const sim::Reading& reading : readings) {
    RobotTopics robot(file, names[reading.robot]);
    const LaserScan& scan = reading.scan;
    if (odometry == OdometryOfBag::kWritten) {
      robot.WriteOdometry(scan.stamp, reading.T_odom_robot);
      if (scan.sweep.count() > 0) {
        robot.WriteOdometry(scan.stamp + scan.sweep, reading.T_odom_robot * reading.T_first_last);
      }
    }
    for (const ImuReading& imu : reading.imu) robot.WriteImu(imu);
    robot.WriteTruth(scan.stamp, reading.T_world_robot);
    robot.WriteScan(scan);
  }
  file.Commit();
}

}  // namespace qwsm::test
