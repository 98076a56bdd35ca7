// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/answer_bag.hpp"

#include <algorithm>
#include <string>

#include "service/io/bags/writing/bag_file.hpp"
#include "service/io/bags/writing/ros_encoding.hpp"

namespace qwsm::pipeline {
namespace {

constexpr const char* kMapFrame = "map";

const io::TopicToWrite kPoses{"/pose", "geometry_msgs/msg/PoseWithCovarianceStamped"};
const io::TopicToWrite kFrames{"/tf", "tf2_msgs/msg/TFMessage"};
const io::TopicToWrite kMap{"/map", "nav_msgs/msg/OccupancyGrid", true};

}  // namespace

void AnswerBag::Take(const TimedStep& timed) {
  answers_.push_back({.stamp = timed.step.stamp,
                      .map_robot = timed.step.map_robot,
                      .T_odom_robot = timed.T_odom_robot});
}

void AnswerBag::Correct(std::span<const UncertainPose2> map_robot) {
  for (std::size_t i = 0; i < answers_.size(); ++i) answers_[i].map_robot = map_robot[i];
}

void AnswerBag::Write(const std::filesystem::path& path,
                      const std::optional<OccupancyGrid>& grid) const {
  io::BagFile bag(path, io::BagFormatOf(path).value_or(io::BagFormat::kMcap));
  // A frame has one parent: where there is odometry, it tells where the robot is in `odom`, which
  // stays where it was while it has a gap.
  const bool has_odometry = std::ranges::any_of(
      answers_, [](const Answer& answer) { return answer.T_odom_robot.has_value(); });
  const char* child = has_odometry ? "odom" : "base_link";
  for (const auto& [stamp, map_robot, T_odom_robot] : answers_) {
    io::CheckRosTime(stamp);
    bag.Write(kPoses, stamp, io::EncodePose(stamp, kMapFrame, map_robot));
    if (has_odometry && !T_odom_robot) continue;
    const Pose2 T_map_child =
        has_odometry ? map_robot.T_a_b * T_odom_robot->Inverse() : map_robot.T_a_b;
    bag.Write(kFrames, stamp, io::EncodeTransform(stamp, kMapFrame, child, T_map_child));
  }
  if (grid && !answers_.empty()) {
    const Timestamp stamp = answers_.back().stamp;
    bag.Write(kMap, stamp, io::EncodeGrid(stamp, kMapFrame, *grid));
  }
  bag.Commit();
}

}  // namespace qwsm::pipeline
