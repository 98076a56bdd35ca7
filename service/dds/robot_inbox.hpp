// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <optional>
#include <string>

#include "service/dds/reader.hpp"
#include "service/dds/refusals.hpp"
#include "service/dds/robot_listener.hpp"
#include "service/dds/robot_names.hpp"
#include "service/dds/static_transforms.hpp"

namespace qwsm::dds {

/// What one robot says: scans, odometry, and where its operator says it is.
class RobotInbox {
 public:
  /// @param refusals outlives this.
  RobotInbox(const Participant& participant, const RobotNames& names, Refusals& refusals);

  std::array<Entity::Handle, 3> handles() const;

  /// Delivers all that has arrived: odometry before scans, for scans are matched with it.
  void Deliver(const StaticTransforms& transforms, RobotListener& listener);

 private:
  void TakeOdometry(const wire::Odometry& sample, RobotListener& listener);
  void TakeScan(const wire::LaserScan& sample);
  void DeliverPlacedScans(const StaticTransforms& transforms, RobotListener& listener);
  void TakeInitialPose(const wire::PoseWithCovarianceStamped& sample, RobotListener& listener);
  std::optional<Pose2> LaserOnRobot(const std::string& laser_frame,
                                    const StaticTransforms& transforms);

  /// A scan that waits until it is known where its laser sits.
  struct UnplacedScan {
    LaserScan scan;
    std::string laser_frame;
  };

  RobotNames names_;
  Refusals& refusals_;
  std::string robot_frame_;
  Reader<wire::Odometry> odometry_;
  Reader<wire::LaserScan> scans_;
  Reader<wire::PoseWithCovarianceStamped> initial_poses_;
  std::deque<UnplacedScan> unplaced_;
  std::optional<std::chrono::steady_clock::time_point> unplaced_since_;
};

}  // namespace qwsm::dds
