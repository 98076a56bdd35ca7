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

void WriteTeamBag(std::span<const sim::Reading> readings,
                  std::span<const std::string> names,
                  const std::filesystem::path& bag) {
  io::BagFile file(bag, io::BagFormat::kMcap);
  for (const sim::Reading& reading : readings) {
    const std::string& robot = names[reading.robot];
    const std::string base = robot + "/base_link";
    const Timestamp stamp = reading.scan.stamp;
    file.Write({"/" + robot + "/odom", "nav_msgs/msg/Odometry"},
               stamp,
               io::EncodeOdometry(stamp, robot + "/odom", base, reading.T_odom_robot));
    file.Write({"/" + robot + "/ground_truth", "nav_msgs/msg/Odometry"},
               stamp,
               io::EncodeOdometry(stamp, "world", base, reading.T_world_robot));
    file.Write(
        {"/tf_static", "tf2_msgs/msg/TFMessage", true},
        stamp,
        io::EncodeTransform(stamp, base, robot + "/laser", reading.scan.geometry.T_robot_laser));
    file.Write({"/" + robot + "/scan", "sensor_msgs/msg/LaserScan"},
               stamp,
               io::EncodeLaserScan(reading.scan, robot + "/laser"));
  }
  file.Commit();
}

}  // namespace qwsm::test
