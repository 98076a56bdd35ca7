// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/message_definitions.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <sstream>
#include <utility>
#include <vector>

namespace qwsm::io {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

// Types and their fields, without comments.
constexpr std::array kDefinitions{
    Entry{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    Entry{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Entry{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    Entry{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    Entry{"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    Entry{"geometry_msgs/Pose",
          "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Entry{"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    Entry{"geometry_msgs/PoseWithCovarianceStamped",
          "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"},
    Entry{"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    Entry{"geometry_msgs/TwistWithCovariance",
          "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    Entry{"geometry_msgs/Transform",
          "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Entry{"geometry_msgs/TransformStamped",
          "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    Entry{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    Entry{"nav_msgs/Odometry",
          "std_msgs/Header header\nstring child_frame_id\n"
          "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist\n"},
    Entry{"nav_msgs/MapMetaData",
          "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\n"
          "uint32 height\ngeometry_msgs/Pose origin\n"},
    Entry{"nav_msgs/OccupancyGrid",
          "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"},
    Entry{"sensor_msgs/LaserScan",
          "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\n"
          "float32 angle_increment\nfloat32 time_increment\nfloat32 scan_time\n"
          "float32 range_min\nfloat32 range_max\nfloat32[] ranges\nfloat32[] intensities\n"},
    Entry{"sensor_msgs/Imu",
          "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
          "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
          "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
          "float64[9] linear_acceleration_covariance\n"},
    Entry{"sensor_msgs/PointField",
          "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\n"
          "uint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
          "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    Entry{"sensor_msgs/PointCloud2",
          "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
          "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
    Entry{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    Entry{"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
    Entry{"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
    Entry{"diagnostic_msgs/DiagnosticStatus",
          "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
          "byte level\nstring name\nstring message\nstring hardware_id\n"
          "diagnostic_msgs/KeyValue[] values\n"},
    Entry{"diagnostic_msgs/DiagnosticArray",
          "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
    Entry{"qwsm_msgs/Pose2D", "float64 x\nfloat64 y\nfloat64 theta\n"},
    Entry{"qwsm_msgs/MatchReport",
          "uint8 FIRST=0\nuint8 MATCHED=1\nuint8 EXTENDED=2\nuint8 DEAD_RECKONED=3\n"
          "std_msgs/Header header\nstring robot\nqwsm_msgs/Pose2D pose\nfloat64[9] covariance\n"
          "uint8 status\nstring reason\nbool relevant\nuint32 pairs\nuint32 iterations\n"
          "float64 overlap\nfloat64 mean_residual\nfloat64 position_trace\nfloat64 duration\n"
          "float64 latency\nuint64 scans\nuint64 dropped\n"},
    Entry{"qwsm_msgs/RelevantScan",
          "std_msgs/Header header\nstring origin\nstring robot\nuint64 sequence_number\n"
          "qwsm_msgs/Pose2D pose\nfloat64[9] covariance\nbool has_odometry\n"
          "qwsm_msgs/Pose2D odometry\nqwsm_msgs/Pose2D laser\nfloat32 angle_min\n"
          "float32 angle_increment\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\n"},
    Entry{"qwsm_msgs/RegistrationReport",
          "std_msgs/Header header\nstring robot\ngeometry_msgs/PoseWithCovariance pose\n"
          "uint8 status\nstring reason\nuint32 points\nuint32 pairs\nuint32 iterations\n"
          "float64 overlap\nfloat64 rms_residual\nuint32[] loops\nfloat64 duration\n"
          "float64 latency\nuint64 scans\nuint64 dropped\n"},
    Entry{"qwsm_msgs/MapTile",
          "std_msgs/Header header\nuint32 generation\nfloat32 resolution\nfloat64 x\nfloat64 y\n"
          "uint32 width\nuint32 height\nuint8[] runs\n"},
    Entry{"qwsm_msgs/MovedScan",
          "string origin\nstring robot\nuint64 sequence_number\nstring frame_before\n"
          "qwsm_msgs/Pose2D before\nstring frame\nqwsm_msgs/Pose2D pose\nfloat64[9] covariance\n"},
    Entry{"qwsm_msgs/MovedRobot",
          "string robot\nstring frame_before\nstring frame\nqwsm_msgs/Pose2D correction\n"},
    Entry{"qwsm_msgs/MapEpoch",
          "std_msgs/Header header\nstring origin\nuint64 number\n"
          "qwsm_msgs/MovedRobot[] robots\nqwsm_msgs/MovedScan[] scans\n"},
    Entry{"qwsm_msgs/Mark",
          "std_msgs/Header header\nstring id\nstring kind\nstring text\nstring author\n"
          "float64 x\nfloat64 y\nbool removed\nuint32 number\nuint64 revision\nbool anchored\n"
          "string anchor_robot\nbuiltin_interfaces/Time anchor_stamp\nfloat64 anchor_x\n"
          "float64 anchor_y\n"},
};

// As rosidl computes them since Iron.
constexpr std::array kHashes{
    Entry{"sensor_msgs/LaserScan",
          "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"},
    Entry{"sensor_msgs/Imu",
          "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"},
    Entry{"nav_msgs/Odometry",
          "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
    Entry{"nav_msgs/OccupancyGrid",
          "RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7"},
    Entry{"tf2_msgs/TFMessage",
          "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
    Entry{"geometry_msgs/PoseWithCovarianceStamped",
          "RIHS01_26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e"},
};

std::string WithoutMsg(std::string_view type) {
  std::string name(type);
  const std::size_t middle = name.find("/msg/");
  if (middle != std::string::npos) name.erase(middle, std::string_view("/msg").size());
  return name;
}

std::string_view FieldsOf(std::string_view type) {
  const auto* const entry = std::ranges::find(kDefinitions, type, &Entry::first);
  assert(entry != kDefinitions.end() && "only types of the table are written");
  return entry->second;
}

/// Types in the fields of a type, and in theirs, in the order in which they are met.
void CollectTypes(std::string_view type, std::vector<std::string>& types) {
  std::istringstream lines{std::string(FieldsOf(type))};
  for (std::string line; std::getline(lines, line);) {
    const std::string field = line.substr(0, line.find_first_of(" ["));
    const bool is_message = field.find('/') != std::string::npos;
    if (!is_message || std::ranges::find(types, field) != types.end()) continue;
    types.push_back(field);
    CollectTypes(field, types);
  }
}

}  // namespace

std::string MessageDefinition(std::string_view type) {
  const std::string name = WithoutMsg(type);
  std::string definition(FieldsOf(name));
  std::vector<std::string> types;
  CollectTypes(name, types);
  for (const std::string& part : types) {
    definition += std::string(80, '=') + "\nMSG: " + part + "\n" + std::string(FieldsOf(part));
  }
  return definition;
}

std::string_view TypeHash(std::string_view type) {
  const auto* const entry = std::ranges::find(kHashes, WithoutMsg(type), &Entry::first);
  return entry == kHashes.end() ? std::string_view() : entry->second;
}

}  // namespace qwsm::io
