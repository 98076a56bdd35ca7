// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/logs/log_report.hpp"
#include "service/io/clouds/cloud_survey.hpp"
#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d::io {

struct CloudBagOptions {
  std::string points;    ///< Topic of clouds; empty: that with the most.
  std::string odometry;  ///< Topic of odometry, or "/tf"; empty: the nearest to that of the clouds.
  int every = 1;         ///< Of so many clouds the first is taken.
};

template <class Visitor>
void Describe(Visitor& visit, CloudBagOptions& o) {
  visit("points", o.points, {.help = "topic of clouds; else that with the most"});
  visit("odometry", o.odometry, {.help = "topic of odometry, or /tf; else chosen"});
  visit("every", o.every, {.help = "of so many clouds one is taken", .min = 1, .max = 1e6});
}

/// The 3D scans of a bag of ROS 1 or 2 (sensor_msgs/PointCloud2), in the order of their stamps,
/// with the sensor's pose by odometry: of nav_msgs/Odometry or /tf, and of where the sensor sits.
class CloudBag {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// A cloud as it was taken.
  struct Cloud {
    qwsm::Timestamp stamp{};
    PointCloud points;                   ///< In the sensor's frame.
    std::optional<Pose3> T_odom_sensor;  ///< Nothing where odometry does not tell.
  };

  /// Surveys a bag. @param tell is told what is damaged, left open or chosen among several.
  /// @throws std::runtime_error naming the bag where it is none, or has no such topics.
  CloudBag(const std::filesystem::path& path, const CloudBagOptions& options, Tell tell);
  CloudBag(const CloudBag&) = delete;
  CloudBag& operator=(const CloudBag&) = delete;

  const std::string& name() const { return report_.name; }
  std::size_t size() const { return places_.size(); }
  /// Reads one of the clouds. @throws std::runtime_error naming bag and message where it is none.
  Cloud Read(std::size_t number);

  /// How the bag was understood, a line for each choice.
  const std::vector<std::string>& notes() const { return report_.notes; }

 private:
  [[noreturn]] void Refuse(const std::string& what) const;
  std::string CloudTopicOf(const std::string& wanted);
  std::string OdometryTopicOf(const std::string& wanted);
  void ChooseOdometry(const std::string& wanted);
  void TakeTransforms(const qwsm::io::TransformTree& tree, const std::string& name_space);
  void MountOn(const std::string& robot_frame, const qwsm::io::TransformTree& tree);

  qwsm::io::LogReport report_;
  qwsm::io::LogOptions options_;
  qwsm::io::BagFaults faults_;
  CloudContents contents_;
  std::string topic_;
  std::string frame_;  ///< The sensor's.
  std::vector<qwsm::io::MessagePlace> places_;
  std::optional<PoseTrack3> odometry_;
  Pose3 T_robot_sensor_;
  std::string buffer_;
};

}  // namespace slam6d::io
