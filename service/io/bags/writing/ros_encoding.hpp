// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "qwsm/sensor/imu_reading.hpp"
#include "qwsm/sensor/laser_scan.hpp"

/// What goes into a bag as messages of ROS 2, in CDR. Numbers come back bit for bit.
/// @pre stamps are not before 1970 and, as ROS 2 has 31 bits for seconds, not after 2038.
namespace qwsm::io {

/// Throws where a stamp cannot be written. @throws WriteError
void CheckRosTime(Timestamp stamp);

std::string EncodeLaserScan(const LaserScan& scan, std::string_view frame);
/// As sensor_msgs/Imu; covariances are not known.
std::string EncodeImu(const ImuReading& reading, std::string_view frame);
/// The pose of a frame in its parent as nav_msgs/Odometry; speeds are 0.
std::string EncodeOdometry(Timestamp stamp,
                           std::string_view frame,
                           std::string_view child,
                           const Pose2& pose);
/// The same as tf2_msgs/TFMessage.
std::string EncodeTransform(Timestamp stamp,
                            std::string_view frame,
                            std::string_view child,
                            const Pose2& pose);
/// As geometry_msgs/PoseWithCovarianceStamped.
std::string EncodePose(Timestamp stamp, std::string_view frame, const UncertainPose2& pose);
/// As nav_msgs/OccupancyGrid: 0 free, 100 occupied, -1 unknown.
std::string EncodeGrid(Timestamp stamp, std::string_view frame, const OccupancyGrid& grid);

}  // namespace qwsm::io
