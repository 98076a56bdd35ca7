// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace qwsm::io {

/// The definition of a type of ROS 2 ("sensor_msgs/msg/LaserScan") with those of all types in it,
/// as MCAP and rosbag2 keep it ("ros2msg"). @pre the type is one of those that are written.
std::string MessageDefinition(std::string_view type);

/// The type's hash as ROS 2 has it since Iron (RIHS01); empty where it is not known.
std::string_view TypeHash(std::string_view type);

}  // namespace qwsm::io
