// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace qwsm::dds {

/// A topic that somebody in the domain publishes.
struct PublishedTopic {
  std::string name;         ///< As ROS has it, such as `/robot1/scan`.
  std::string type;         ///< As ROS has it, such as `sensor_msgs/msg/LaserScan`.
  bool is_latched = false;  ///< Late readers get what was published before.

  bool operator==(const PublishedTopic&) const = default;
};

/// The ROS name of a DDS topic; nothing for topics that are none of ROS.
std::optional<std::string> RosTopicOf(std::string_view dds_topic);

/// The ROS name of a type of DDS: `sensor_msgs/msg/Imu` of `sensor_msgs::msg::dds_::Imu_`.
std::string RosTypeOf(std::string_view dds_type);

}  // namespace qwsm::dds
