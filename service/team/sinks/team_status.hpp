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

/// What a robot is called where people read it: one without a namespace is the only one.
inline std::string DisplayName(std::string_view robot) {
  return robot.empty() ? "robot" : std::string(robot);
}

enum class RobotState {
  kExpected,  ///< Configured, but not heard of yet.
  kUnplaced,  ///< Its scans arrive, but nobody knows where in the map it is.
  kTracked,
  kLost,       ///< Its publisher is gone.
  kElsewhere,  ///< Another service answers it.
};

std::string_view Name(RobotState state);

/// What became of a robot's messages.
struct SessionCounts {
  std::uint64_t scans = 0;             ///< That arrived, whatever became of them.
  std::uint64_t answered = 0;          ///< With a pose.
  std::uint64_t dead_reckoned = 0;     ///< Of these, without a match.
  std::uint64_t relevant = 0;          ///< Of these, added to the map.
  std::uint64_t without_odometry = 0;  ///< Of these.
  std::uint64_t dropped = 0;           ///< The queue was full: the oldest went.
  std::uint64_t late = 0;              ///< Overtaken on their way; answered all the same.
  std::uint64_t duplicates = 0;        ///< Refused: of a stamp that has come already.
  std::uint64_t wrong_time = 0;        ///< Refused: from the future or long past.
  std::uint64_t malformed = 0;         ///< Refused: see ObjectionTo().
  std::uint64_t unplaced = 0;          ///< Left out: nobody knew yet where the robot was.
  std::uint64_t clock_resets = 0;      ///< The robot's clock was set.
  std::uint64_t odometry_readings = 0;
  std::uint64_t odometry_refused = 0;
  std::uint64_t odometry_jumps = 0;          ///< Faster than any robot: odometry began anew.
  std::uint64_t contradicted_poses = 0;      ///< Initial poses that its scans contradicted.
  std::uint64_t contradicted_mountings = 0;  ///< Places of its laser that they contradicted.
};

struct LatencySummary {
  std::chrono::nanoseconds median{};
  std::chrono::nanoseconds p99{};
  std::chrono::nanoseconds longest{};
};

struct RobotStatus {
  std::string name;
  RobotState state = RobotState::kExpected;
  UncertainPose2 map_robot{};  ///< At its last answered scan.
  Timestamp stamp{};           ///< Of that scan.
  std::size_t waiting = 0;     ///< Scans in the queue.
  SessionCounts counts;
  LatencySummary matching;  ///< Of the match alone.
  LatencySummary latency;   ///< From the arrival of a scan to its pose.
};

struct MapStatus {
  std::size_t scans = 0;
  std::size_t points = 0;
  std::uint64_t taken_in = 0;    ///< Scans of other services.
  std::uint64_t duplicates = 0;  ///< Of these, known already.
  std::uint64_t refused = 0;     ///< Of these, malformed.
};

struct JournalStatus {
  std::string file;           ///< Empty: there is none.
  std::string trouble;        ///< Why nothing can be written at the moment; empty: all is well.
  std::uint64_t stored = 0;   ///< Scans that are safely on disk.
  std::uint64_t waiting = 0;  ///< Scans that are not yet.
};

/// How the service is.
struct TeamStatus {
  std::string service;  ///< TeamService::identity().
  std::chrono::nanoseconds uptime{};
  std::vector<RobotStatus> robots{};
  MapStatus map{};
  JournalStatus journal{};
};

}  // namespace qwsm::team
