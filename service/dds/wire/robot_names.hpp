// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace qwsm::dds {

/// How the topics and frames of one robot are called.
///
/// A robot in the namespace `/robot1` has topics `/robot1/scan`..., and frames `robot1/odom`... on
/// the /tf that all share; one without a namespace has `/scan` and `odom`.
class RobotNames {
 public:
  /// Derives the names of one robot.
  /// @param name `robot1`, or empty for a robot without a namespace; slashes around it are cut.
  explicit RobotNames(std::string_view name);

  /// The robot to which a topic with this last part belongs; nothing for other topics.
  /// `RobotOf("rt/robot1/scan", "scan")` is `robot1`.
  static std::optional<std::string> RobotOf(std::string_view dds_topic, std::string_view part);

  const std::string& name() const { return name_; }
  std::string Topic(std::string_view part) const;
  std::string Frame(std::string_view part) const;

 private:
  std::string name_;
};

/// Last parts of the names of topics, after the namespace.
inline constexpr std::string_view kScanTopic = "scan";
inline constexpr std::string_view kCloudTopic = "points";
inline constexpr std::string_view kOdometryTopic = "odom";
inline constexpr std::string_view kImuTopic = "imu";
inline constexpr std::string_view kTruthTopic = "ground_truth";
inline constexpr std::string_view kCommandTopic = "cmd_vel";
inline constexpr std::string_view kInitialPoseTopic = "initialpose";
inline constexpr std::string_view kPoseTopic = "pose";
inline constexpr std::string_view kMatchedOdometryTopic = "odometry/matched";
inline constexpr std::string_view kReportTopic = "match_report";
inline constexpr std::string_view kRegistrationTopic = "registration_report";
inline constexpr std::string_view kPathTopic = "path";
inline constexpr std::string_view kCloudMapTopic = "cloud_map";
/// The map of the team where it has no namespace.
inline constexpr std::string_view kMapTopic = "map";
/// Corrections of that map.
inline constexpr std::string_view kMapEpochTopic = "map_epoch";

/// Topics the whole team shares.
inline constexpr const char* kTransformsTopic = "/tf";
inline constexpr const char* kStaticTransformsTopic = "/tf_static";
inline constexpr const char* kNewPointsTopic = "/map_points";
inline constexpr const char* kDiagnosticsTopic = "/diagnostics";
inline constexpr const char* kGraphTopic = "/ros_discovery_info";
inline constexpr const char* kSharedScansTopic = "/qwsm/relevant_scans";
inline constexpr const char* kMarksTopic = "/qwsm/marks";

/// Types robots are known by.
inline constexpr const char* kLaserScanType = "sensor_msgs::msg::dds_::LaserScan_";
inline constexpr const char* kPointCloudType = "sensor_msgs::msg::dds_::PointCloud2_";
inline constexpr const char* kRegistrationReportType = "qwsm_msgs::msg::dds_::RegistrationReport_";
inline constexpr const char* kMatchReportType = "qwsm_msgs::msg::dds_::MatchReport_";

/// Longest name of a robot, service or frame; what is longer is no name but an attack.
inline constexpr std::size_t kMaxNameLength = 256;

/// Names of frames; a robot's own are prefixed by its name.
inline constexpr const char* kMapFrame = "map";
inline constexpr const char* kWorldFrame = "world";  ///< The simulator's frame.
inline constexpr std::string_view kOdometryFrame = "odom";
inline constexpr std::string_view kRobotFrame = "base_link";
/// Below it, on the floor, where a robot has one.
inline constexpr std::string_view kFloorFrame = "base_footprint";
inline constexpr std::string_view kLaserFrame = "laser";

}  // namespace qwsm::dds
