// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {

/// Where the robots that share a map are, so that none takes another for a part of the place. All
/// functions may be called from any thread.
class RobotPositions {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A position counts as fresh for so long: later the robot may be anywhere, or has stopped and
  /// stands still for long enough to be one more thing to be guided by.
  static constexpr std::chrono::nanoseconds kFresh = std::chrono::seconds(1);

  void Report(std::string_view robot, const Eigen::Vector2d& p_map_m, Time now);
  /// The fresh positions of all robots but the given one.
  std::vector<Eigen::Vector2d> OthersThan(std::string_view robot, Time now) const;

 private:
  struct Sighting {
    Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
    Time at{};
  };

  mutable std::mutex mutex_;
  std::map<std::string, Sighting, std::less<>> by_robot_;
};

/// Makes the readings of a scan invalid that end within the radius of one of the positions: what is
/// there moves.
void HideRobots(std::span<const Eigen::Vector2d> positions_map_m,
                double radius_m,
                const Pose2& T_map_robot,
                LaserScan& scan);

}  // namespace qwsm::team
