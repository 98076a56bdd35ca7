// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {

/// The name of a robot where people read it: one without a namespace is the only one, `robot`.
inline std::string DisplayName(std::string_view robot) {
  return robot.empty() ? "robot" : std::string(robot);
}

enum class RobotState {
  kExpected,  ///< The robot is configured, but not heard of yet.
  kUnplaced,  ///< The robot's scans arrive, but nobody knows where in the map it is.
  kTracked,
  kLost,       ///< The robot's publisher is gone.
  kElsewhere,  ///< Another service answers the robot.
};

std::string_view Name(RobotState state);

/// Counts of a robot's messages, by what became of them.
struct SessionCounts {
  std::uint64_t scans = 0;             ///< Scans that arrived, whatever became of them.
  std::uint64_t answered = 0;          ///< Scans answered with a pose.
  std::uint64_t dead_reckoned = 0;     ///< Scans answered without a match.
  std::uint64_t relevant = 0;          ///< Scans added to the map.
  std::uint64_t without_odometry = 0;  ///< Scans answered without odometry.
  std::uint64_t dropped = 0;           ///< Scans dropped: the queue was full, the oldest went.
  std::uint64_t late = 0;              ///< Scans overtaken on their way; answered all the same.
  std::uint64_t duplicates = 0;        ///< Scans refused: of a stamp that has come already.
  std::uint64_t wrong_time = 0;        ///< Scans refused: from the future or long past.
  std::uint64_t malformed = 0;         ///< Scans refused: see ObjectionTo().
  std::uint64_t unplaced = 0;          ///< Scans left out: nobody knew yet where the robot was.
  std::uint64_t clock_resets = 0;      ///< How often the robot's clock was set.
  std::uint64_t odometry_readings = 0;
  std::uint64_t odometry_refused = 0;
  /// How often odometry was faster than any robot: it began anew.
  std::uint64_t odometry_jumps = 0;
  std::uint64_t contradicted_poses = 0;      ///< Initial poses that its scans contradicted.
  std::uint64_t contradicted_mountings = 0;  ///< Places of its laser that its scans contradicted.
};

struct LatencySummary {
  std::chrono::nanoseconds median{};
  std::chrono::nanoseconds p99{};
  std::chrono::nanoseconds longest{};
};

struct RobotStatus {
  std::string name;
  RobotState state = RobotState::kExpected;
  std::string component{};     ///< Of the team's map, that it is in.
  UncertainPose2 map_robot{};  ///< Pose at the robot's last answered scan.
  Timestamp stamp{};           ///< Stamp of the robot's last answered scan.
  /// Since when none of its scans has come, used or not; 0 before the first.
  std::chrono::nanoseconds silence{};
  std::size_t waiting = 0;  ///< Scans in the queue.
  SessionCounts counts;
  LatencySummary matching;  ///< Time of the match alone.
  LatencySummary latency;   ///< Time from the arrival of a scan to its pose.
};

struct MapStatus {
  std::size_t scans = 0;
  std::size_t points = 0;
  std::size_t corrections = 0;   ///< How often it was corrected since the start.
  std::uint64_t taken_in = 0;    ///< Scans of other services that were new to the map.
  std::uint64_t duplicates = 0;  ///< Scans of other services that were known already.
  std::uint64_t refused = 0;     ///< Scans of other services that were malformed.
};

struct JournalStatus {
  std::string file;           ///< The journal's file; empty where there is none.
  std::string trouble;        ///< Why nothing can be written at the moment; empty: all is well.
  std::uint64_t stored = 0;   ///< Scans that are safely on disk.
  std::uint64_t waiting = 0;  ///< Scans that are not yet on disk.
};

/// How the service is: itself, its robots, map and journal.
struct TeamStatus {
  std::string service;  ///< Name of the service: TeamService::identity().
  std::chrono::nanoseconds uptime{};
  std::vector<RobotStatus> robots{};
  MapStatus map{};
  JournalStatus journal{};
};

}  // namespace qwsm::team
