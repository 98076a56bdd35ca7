// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/driver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sim {
namespace {

constexpr double kTurnFirst_rad = qwsm::DegreesToRadians(60.0);  // A larger error is turned away.
constexpr double kSteeringGain_per_s = 2.0;
constexpr double kKeptAhead_m = 0.2;    // A skilled driver stops so far from an obstacle.
constexpr double kBraking_per_s = 1.0;  // Speed over the way left to where the driver stops.
constexpr double kPoorTolerance_rad = qwsm::DegreesToRadians(25.0);  // Not worth a turn.
constexpr double kPoorAim_rad = qwsm::DegreesToRadians(6.0);         // Good enough to drive on.
constexpr std::size_t kPoorReactionSteps = 40;                       // 0.4 s of Decide() calls.

// Without progress for so long a robot is stuck, and backs off for a while. Both times are drawn
// at random, or robots that are in each other's way would go on so for ever.
constexpr double kMinPatience_s = 2.0;
constexpr double kMaxPatience_s = 5.0;
constexpr double kMinEscape_s = 1.0;
constexpr double kMaxEscape_s = 4.0;
constexpr double kProgress_m = 0.15;
constexpr double kProgress_rad = 0.2;

qwsm::Timestamp ToTimestamp(double seconds) {
  return std::chrono::round<qwsm::Timestamp>(std::chrono::duration<double>(seconds));
}

bool IsFarFrom(const qwsm::Pose2& a, const qwsm::Pose2& b) {
  const qwsm::Pose2 T_a_b = a.Inverse() * b;
  return T_a_b.translation_m().norm() > kProgress_m || std::abs(T_a_b.theta_rad) > kProgress_rad;
}

}  // namespace

Driver::Driver(DriverOptions options, Route route, std::uint64_t seed)
    : options_(std::move(options)), route_(std::move(route)), random_(seed) {
  assert((!FollowsWaypoints(options_.kind) || !route_.empty()) && "there is somewhere to go");
}

VelocityCommand Driver::Decide(const DriverView& view) {
  if (options_.kind == DriverKind::kExternal) return external_;
  if (options_.kind == DriverKind::kRecorded) return PlayBack(view.now);
  return Follow(view);
}

double Driver::share_done() const {
  const std::size_t total = FollowsWaypoints(options_.kind)
                                ? route_.size() * static_cast<std::size_t>(options_.laps)
                                : options_.commands.size();
  return total == 0 ? 0.0 : static_cast<double>(passed_) / static_cast<double>(total);
}

qwsm::Pose2 Driver::PoseAhead(std::size_t waypoints) const {
  assert(FollowsWaypoints(options_.kind) && "there is a way");
  const std::size_t index = IndexAhead(waypoints);
  const auto at = [this](std::size_t i) { return route_[i % route_.size()].position_m(); };
  const bool is_last = index + 1 == LastIndex();
  const Eigen::Vector2d leg_m =
      is_last ? at(index) - at(index + route_.size() - 1) : at(index + 1) - at(index);
  return {at(index).x(), at(index).y(), std::atan2(leg_m.y(), leg_m.x())};
}

VelocityCommand Driver::PlayBack(qwsm::Timestamp now) {
  const std::vector<TimedCommandOptions>& commands = options_.commands;
  while (passed_ < commands.size() && ToTimestamp(commands[passed_].start_s) <= now) ++passed_;
  has_arrived_ = passed_ == commands.size();
  if (passed_ == 0) return {};
  const TimedCommandOptions& current = commands[passed_ - 1];
  return {.forward_mps = current.forward_mps, .turn_rad_s = current.turn_rad_s};
}

VelocityCommand Driver::Follow(const DriverView& view) {
  const std::size_t last = LastIndex();
  const Eigen::Vector2d p_world_robot = view.T_world_robot.translation_m();
  const auto goal = [&] { return route_[passed_ % route_.size()].position_m(); };
  while (passed_ < last && (goal() - p_world_robot).norm() < options_.arrival_m) ++passed_;
  has_arrived_ = passed_ == last;
  if (has_arrived_) return {};

  NoteProgress(view);
  if (view.now < escape_until_) return Escape(view);
  const Eigen::Vector2d p_robot_goal = view.T_world_robot.Inverse() * goal();
  const double error_rad = std::atan2(p_robot_goal.y(), p_robot_goal.x());
  if (options_.kind == DriverKind::kPoor) return SteerPoorly(error_rad);
  return SteerSmoothly(error_rad, view.free_ahead_m);
}

VelocityCommand Driver::Escape(const DriverView& view) const {
  const double free_m = escape_.forward_mps > 0.0 ? view.free_ahead_m : view.free_behind_m;
  if (free_m > 0.5 * kKeptAhead_m) return escape_;
  return {.forward_mps = 0.0, .turn_rad_s = escape_.turn_rad_s};
}

VelocityCommand Driver::SteerSmoothly(double error_rad, double free_ahead_m) const {
  const double turn_rad_s =
      std::clamp(kSteeringGain_per_s * error_rad, -options_.turn_rad_s, options_.turn_rad_s);
  if (std::abs(error_rad) > kTurnFirst_rad) return {.forward_mps = 0.0, .turn_rad_s = turn_rad_s};
  const double in_curve_mps = options_.speed_mps * std::cos(error_rad) * std::cos(error_rad);
  const double brakes_mps = kBraking_per_s * std::max(0.0, free_ahead_m - kKeptAhead_m);
  return {.forward_mps = std::min(in_curve_mps, brakes_mps), .turn_rad_s = turn_rad_s};
}

VelocityCommand Driver::SteerPoorly(double error_rad) {
  seen_errors_rad_.push_back(error_rad);
  if (seen_errors_rad_.size() > kPoorReactionSteps) seen_errors_rad_.pop_front();
  const double late_error_rad = seen_errors_rad_.front();
  is_turning_ = std::abs(late_error_rad) > (is_turning_ ? kPoorAim_rad : kPoorTolerance_rad);
  if (!is_turning_) return {.forward_mps = options_.speed_mps, .turn_rad_s = 0.0};
  return {.forward_mps = 0.0, .turn_rad_s = std::copysign(options_.turn_rad_s, late_error_rad)};
}

void Driver::NoteProgress(const DriverView& view) {
  const auto after = [&](double min_s, double max_s) {
    return view.now + ToTimestamp(Uniform(random_, min_s, max_s));
  };
  if (!last_progress_T_world_robot_ ||
      IsFarFrom(*last_progress_T_world_robot_, view.T_world_robot)) {
    stuck_from_ = after(kMinPatience_s, kMaxPatience_s);
    last_progress_T_world_robot_ = view.T_world_robot;
  }
  if (view.now < stuck_from_ || view.now < escape_until_) return;
  const bool goes_back =
      view.free_behind_m > kKeptAhead_m || view.free_behind_m > view.free_ahead_m;
  const bool is_straight = Uniform(random_, 0.0, 1.0) < 0.5;  // The way out of a gap.
  const double max_turn_rad_s = options_.turn_rad_s;
  escape_ = {.forward_mps = (goes_back ? -0.5 : 0.5) * options_.speed_mps,
             .turn_rad_s = is_straight ? 0.0 : Uniform(random_, -max_turn_rad_s, max_turn_rad_s)};
  escape_until_ = after(kMinEscape_s, kMaxEscape_s);
  // The leg is driven again from its beginning: from elsewhere there may be no way.
  if (passed_ > 0) --passed_;
}

}  // namespace sim
