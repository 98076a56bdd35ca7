// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "service/io/bags/assembly/bag_survey.hpp"

namespace qwsm::io {

/// A laser of the robot that is read.
struct LaserChoice {
  std::string topic;
  std::string name;  ///< "front"; of several, the others are "rear", "laser3" ...
  Pose2 T_robot_laser;
  double height_m = 0.0;        ///< Above the floor, or the robot's frame; 0: not known.
  bool is_upside_down = false;  ///< Its bearings count clockwise, seen from above.
  bool is_placed = false;       ///< Transforms say where it sits.
  bool is_level = true;
};

/// What of a bag is read.
struct RobotChoice {
  std::vector<LaserChoice> lasers;
  OdometryTrack odometry;
  std::vector<ImuReading> imu;  ///< By stamp, about the robot's axes.
  OdometryTrack truth;
};

/// Chooses a robot, its lasers, its odometry and where they sit, by the types of the topics and by
/// the options, and tells it. What is chosen is taken out of the contents.
///
/// A robot is a namespace with odometry of its own, whether nav_msgs/Odometry or /tf; where there
/// is only one, all scans are its own. Topics of one frame are one laser told twice, as raw and
/// filtered scans are: of them the one with the most messages is read. All lasers of the robot are
/// read, unless options name some.
/// @throws LogError where an option names what is not there, or does not say which robot is meant.
RobotChoice ChooseRobot(BagContents& contents,
                        const LogOptions& options,
                        LogReport& report,
                        BagFaults& faults);

}  // namespace qwsm::io
