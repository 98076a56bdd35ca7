// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/topic_type.hpp"

#include <algorithm>
#include <array>

namespace qwsm::dds {
namespace {

template <class T>
TopicType TypeOf(std::string_view ros_name) {
  return {.ros_name = ros_name, .descriptor = wire::kDescriptor<T>};
}

const std::array kTopicTypes{
    TypeOf<wire::LaserScan>("sensor_msgs/msg/LaserScan"),
    TypeOf<wire::Imu>("sensor_msgs/msg/Imu"),
    TypeOf<wire::PointCloud2>("sensor_msgs/msg/PointCloud2"),
    TypeOf<wire::PoseWithCovarianceStamped>("geometry_msgs/msg/PoseWithCovarianceStamped"),
    TypeOf<wire::Twist>("geometry_msgs/msg/Twist"),
    TypeOf<wire::TFMessage>("tf2_msgs/msg/TFMessage"),
    TypeOf<wire::Odometry>("nav_msgs/msg/Odometry"),
    TypeOf<wire::OccupancyGrid>("nav_msgs/msg/OccupancyGrid"),
    TypeOf<wire::Path>("nav_msgs/msg/Path"),
    TypeOf<wire::DiagnosticArray>("diagnostic_msgs/msg/DiagnosticArray"),
    TypeOf<wire::MapEpoch>("qwsm_msgs/msg/MapEpoch"),
    TypeOf<wire::Mark>("qwsm_msgs/msg/Mark"),
    TypeOf<wire::MatchReport>("qwsm_msgs/msg/MatchReport"),
    TypeOf<wire::RegistrationReport>("qwsm_msgs/msg/RegistrationReport"),
    TypeOf<wire::RelevantScan>("qwsm_msgs/msg/RelevantScan"),
};

}  // namespace

Profile TopicType::ReaderProfile(bool is_latched) const {
  if (!is_latched) return Profile::kSensorIn;
  if (descriptor == wire::kDescriptor<wire::RelevantScan>) return Profile::kSharedScansIn;
  if (descriptor == wire::kDescriptor<wire::Mark>) return Profile::kMarks;
  // Each program that has transforms to tell tells them once.
  if (descriptor == wire::kDescriptor<wire::TFMessage>) return Profile::kStaticTransforms;
  return Profile::kLatchedIn;
}

const TopicType* FindTopicType(std::string_view dds_name) {
  const auto* const found = std::ranges::find_if(
      kTopicTypes, [&](const TopicType& type) { return dds_name == type.descriptor->m_typename; });
  return found == kTopicTypes.end() ? nullptr : found;
}

}  // namespace qwsm::dds
