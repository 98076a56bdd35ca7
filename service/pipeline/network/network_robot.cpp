// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/network_robot.hpp"

#include <string>
#include <vector>

#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {
namespace {

constexpr std::size_t kScansOnTheirWay = 3;
// Of a team; measured before the start, say.
constexpr double kStartSigma_m = 0.03;
constexpr double kStartSigma_rad = 0.01;
// Who hears the scans hears of the start a moment later, if at all.
constexpr int kMaxScansHeldBack = 10;

const std::string& NameOf(const sim::Simulation& simulation, std::size_t robot) {
  return simulation.robots()[robot].options().name;
}

bool TellsStart(const sim::Simulation& simulation, std::size_t robot) {
  return simulation.robots().size() > 1 && simulation.robots()[robot].options().tells_start;
}

}  // namespace

NetworkRobot::NetworkRobot(const dds::Participant& participant,
                           sim::Simulation& simulation,
                           std::size_t robot,
                           NetworkPace pace,
                           bool is_watched)
    : simulation_(simulation),
      robot_(robot),
      pace_(pace),
      is_watched_(is_watched),
      has_begun_(!TellsStart(simulation, robot)),
      reports_(participant, {NameOf(simulation, robot)}),
      commands_(participant, dds::RobotNames(NameOf(simulation, robot))),
      publisher_(participant,
                 dds::RobotNames(NameOf(simulation, robot)),
                 dds::OdometryUse::kPublished,
                 simulation.robots()[robot].options().gyro.enabled ? dds::ImuUse::kPublished
                                                                   : dds::ImuUse::kNone),
      window_(reports_, kScansOnTheirWay) {}

bool NetworkRobot::WaitForListener(std::chrono::nanoseconds timeout) {
  const auto until = std::chrono::steady_clock::now() + timeout;
  const sim::LaserOptions& laser = simulation_.robots()[robot_].options().laser;
  const Pose2 T_robot_laser{
      laser.mount_x_m, laser.mount_y_m, NormalizeAngle(laser.mount_heading_rad)};
  if (!publisher_.WaitForListener(T_robot_laser, timeout)) return false;
  while (!reports_.has_writer() || (!has_begun_ && !publisher_.has_pose_listener())) {
    if (std::chrono::steady_clock::now() >= until) return false;
    reports_.Take(std::chrono::milliseconds(10));
  }
  return true;
}

void NetworkRobot::Take(const sim::Reading& reading) {
  if (reading.robot != robot_) return;
  if (const std::optional<dds::VelocityRequest> command = commands_.Take()) {
    simulation_.SetCommand(
        robot_, {.forward_mps = command->forward_mps, .turn_rad_s = command->turn_rad_s});
  }
  publisher_.PublishTruth(reading.scan.stamp, reading.T_world_robot);
  if (!HasBegun(reading)) return;
  std::optional<Pose2> T_odom_end;
  if (reading.scan.sweep.count() > 0) T_odom_end = reading.T_odom_robot * reading.T_first_last;
  publisher_.PublishImu(reading.imu);
  publisher_.Publish({.scan = reading.scan, .T_odom_robot = reading.T_odom_robot}, T_odom_end);
  if (pace_ == NetworkPace::kFree) return;
  window_.NoteSent(reading.scan.stamp);
  if (!window_.WaitForRoom(kPatience)) {
    messages::Warn("{}: no answer for {} s; going on", names().name(), kPatience.count());
  }
}

// Topics overtake each other: the first scan follows the start by one period.
bool NetworkRobot::HasBegun(const sim::Reading& reading) {
  if (has_begun_) return true;
  if (publisher_.has_pose_listener()) {
    publisher_.TellPose(
        reading.scan.stamp,
        UncertainPose2::WithSigmas(
            sim::ToldStart(simulation_.robots()[robot_].options(), reading.T_world_robot),
            kStartSigma_m,
            kStartSigma_rad));
    has_begun_ = true;
    return false;
  }
  // A service listens to odometry, too; a page does not.
  if (!publisher_.has_listener()) return is_watched_;
  has_begun_ = ++scans_held_back_ > kMaxScansHeldBack;
  return has_begun_;
}

void NetworkRobot::Finish() {
  if (pace_ == NetworkPace::kAnswers) window_.WaitForAll(kPatience);
  publisher_.Finish(kPatience);
}

}  // namespace qwsm::pipeline
