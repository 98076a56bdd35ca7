// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "sim/random.hpp"
#include "sim/waypoint.hpp"
#include "sim/wheel_drive.hpp"

namespace sim {

enum class DriverKind {
  kSkilled,  ///< Follows the way points in smooth curves and stops for what is in the way.
  /// Follows the way points jerkily: reacts late, turns on the spot as fast as the robot can.
  kPoor,
  kRecorded,  ///< Plays the commands of a recorded drive back.
  kExternal,  ///< Takes commands from outside the simulation.
};

inline std::span<const std::pair<std::string_view, DriverKind>> Names(DriverKind) {
  static constexpr std::array<std::pair<std::string_view, DriverKind>, 4> kNames{
      {{"skilled", DriverKind::kSkilled},
       {"poor", DriverKind::kPoor},
       {"recorded", DriverKind::kRecorded},
       {"external", DriverKind::kExternal}}};
  return kNames;
}

constexpr bool FollowsWaypoints(DriverKind kind) {
  return kind == DriverKind::kSkilled || kind == DriverKind::kPoor;
}

/// A command of a recorded drive, in force until the next one.
struct TimedCommandOptions {
  double start_s = 0.0;
  double forward_mps = 0.0;
  double turn_rad_s = 0.0;
};

template <class Visitor>
void Describe(Visitor& visit, TimedCommandOptions& o) {
  visit("start_s", o.start_s, {.help = "when it is given", .min = 0, .max = 1e6});
  visit("forward_mps", o.forward_mps, {.help = "speed asked for", .min = -20, .max = 20});
  visit("turn_rad_s", o.turn_rad_s, {.help = "turning asked for, in rad/s", .min = -20, .max = 20});
}

struct DriverOptions {
  DriverKind kind = DriverKind::kSkilled;
  Route waypoints{};  ///< Where empty, the layout's own route is driven from its beginning.
  double speed_mps = 0.5;
  double turn_rad_s = 0.8;
  double arrival_m = 0.4;  ///< A way point counts as reached from this far.
  int laps = 1;            ///< How often the way points are gone through.
  std::vector<TimedCommandOptions>
      commands{};             ///< Commands of a recorded drive, in the order of their times.
  std::string command_log{};  ///< A file with the commands; whoever loads the scenario reads it.
};

template <class Visitor>
void Describe(Visitor& visit, DriverOptions& o) {
  visit("kind", o.kind, {.help = "who drives"});
  visit("waypoints", o.waypoints, {.help = "where to go; empty takes the layout's route"});
  visit("speed_mps", o.speed_mps, {.help = "forward speed", .min = 0.01, .max = 20});
  visit("turn_rad_s", o.turn_rad_s, {.help = "fastest turning, in rad/s", .min = 0.01, .max = 20});
  visit("arrival_m",
        o.arrival_m,
        {.help = "distance from which a way point is reached", .min = 0.05, .max = 20});
  visit(
      "laps", o.laps, {.help = "how often the way points are gone through", .min = 1, .max = 1000});
  visit("commands", o.commands, {.help = "a recorded drive, in the order of its times"});
  visit("command_log",
        o.command_log,
        {.help =
             "a file of commands, beside the scenario: lines of 'stamp_s forward_mps turn_rad_s'"});
}

template <class Report>
void Validate(const DriverOptions& o, Report& report) {
  if (o.kind == DriverKind::kRecorded && o.commands.empty() && o.command_log.empty()) {
    report("commands", "a recorded drive needs commands or a command_log");
  }
  if (!o.command_log.empty() && (o.kind != DriverKind::kRecorded || !o.commands.empty())) {
    report("command_log", "belongs to a recorded drive, and in place of commands");
  }
  const auto is_earlier = [](const auto& a, const auto& b) { return a.start_s < b.start_s; };
  if (!std::ranges::is_sorted(o.commands, is_earlier)) {
    report("commands", "must be in the order of their start_s");
  }
}

/// What a driver sees: the truth, as an operator beside the robot would.
struct DriverView {
  qwsm::Timestamp now{};
  qwsm::Pose2 T_world_robot{};
  double free_ahead_m = 0.0;   ///< From the robot's front to what it would bump into.
  double free_behind_m = 0.0;  ///< From the robot's back to what it would bump into.
};

/// Steers one robot.
class Driver {
 public:
  /// Makes a driver. @pre a driver that follows way points has at least one
  Driver(DriverOptions options, Route route, std::uint64_t seed);

  VelocityCommand Decide(const DriverView& view);

  /// Gives the command that an external driver follows until the next one.
  void SetCommand(const VelocityCommand& command) { external_ = command; }

  /// The pose at the way point so many further on, or at the last one, looking along the way.
  /// @pre the driver follows way points
  qwsm::Pose2 PoseAhead(std::size_t waypoints) const;
  /// Goes on from there.
  void GoOnAhead(std::size_t waypoints) { passed_ = IndexAhead(waypoints); }

  /// Whether the last way point or command is behind; never for an external driver.
  bool has_arrived() const { return has_arrived_; }

  /// How much of the way points or commands is behind, 0..1; 0 for an external driver.
  double share_done() const;

 private:
  std::size_t LastIndex() const { return route_.size() * static_cast<std::size_t>(options_.laps); }
  std::size_t IndexAhead(std::size_t waypoints) const {
    return std::min(passed_ + waypoints, LastIndex() - 1);
  }
  VelocityCommand PlayBack(qwsm::Timestamp now);
  VelocityCommand Follow(const DriverView& view);
  VelocityCommand Escape(const DriverView& view) const;
  VelocityCommand SteerSmoothly(double error_rad, double free_ahead_m) const;
  VelocityCommand SteerPoorly(double error_rad);
  void NoteProgress(const DriverView& view);

  DriverOptions options_;
  Route route_;
  std::size_t passed_ = 0;  ///< Way points or commands passed, over all laps.
  bool has_arrived_ = false;
  VelocityCommand external_;

  bool is_turning_ = false;             ///< Whether a poor driver turns; it either turns or drives.
  std::deque<double> seen_errors_rad_;  ///< Errors that a poor driver has not reacted to yet.

  std::optional<qwsm::Pose2> last_progress_T_world_robot_;
  /// When the driver counts as stuck, unless there is progress before.
  qwsm::Timestamp stuck_from_{};
  qwsm::Timestamp escape_until_{};
  VelocityCommand escape_;
  RandomEngine random_;
};

}  // namespace sim
