// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/turn_check.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kLeastTurnBeams = 4.0;  // Less is lost among edges.
constexpr double kMostTurn_rad = 0.5;    // More, and the scans have too little in common.
constexpr double kMostDrive_m = 0.5;
constexpr double kMostDifference_m = 1.0;  // Of two readings: edges are not to outweigh walls.
constexpr std::size_t kLeastPairs = 30;
constexpr double kClearly = 0.7;  // One side explains the scan so much better than the other.
constexpr std::size_t kLeastVotes = 20;
constexpr std::size_t kMajority = 5;
constexpr std::size_t kMostLasers = 8;

/// Mean difference of readings, were those of `now` `shift` beams further than before; nothing
/// where too few can be compared.
std::optional<double> DifferenceAt(const LaserScan& before, const LaserScan& now, long shift) {
  double sum_m = 0.0;
  std::size_t pairs = 0;
  const auto size = static_cast<long>(before.size());
  for (long i = std::max(0L, -shift); i < std::min(size, size - shift); ++i) {
    const float a_m = before.ranges_m[static_cast<std::size_t>(i)];
    const float b_m = now.ranges_m[static_cast<std::size_t>(i + shift)];
    if (StateOf(a_m, before.geometry) != BeamState::kHit) continue;
    if (StateOf(b_m, now.geometry) != BeamState::kHit) continue;
    sum_m += std::min(kMostDifference_m, static_cast<double>(std::abs(a_m - b_m)));
    ++pairs;
  }
  if (pairs < kLeastPairs) return std::nullopt;
  return sum_m / static_cast<double>(pairs);
}

}  // namespace

void TurnCheck::Add(const LaserScan& scan, const std::optional<Pose2>& T_odom_robot) {
  if (!T_odom_robot || scan.size() < kLeastPairs) return;
  View now{.scan = scan, .T_odom_robot = *T_odom_robot};
  const auto same_laser = std::ranges::find_if(views_, [&](const View& view) {
    return view.scan.geometry.T_robot_laser == scan.geometry.T_robot_laser;
  });
  if (same_laser == views_.end()) {
    if (views_.size() < kMostLasers) views_.push_back(std::move(now));
    return;
  }
  const Pose2 motion = same_laser->T_odom_robot.Inverse() * now.T_odom_robot;
  const double beams = motion.theta_rad / static_cast<double>(scan.geometry.bearing_step_rad);
  const bool is_near = motion.translation_m().norm() <= kMostDrive_m;
  if (is_near && std::abs(beams) < kLeastTurnBeams) return;  // Let it turn on.
  const bool is_comparable = is_near && std::abs(motion.theta_rad) <= kMostTurn_rad &&
                             same_laser->scan.size() == scan.size() &&
                             std::abs(beams) < static_cast<double>(scan.size());
  // What stands still is seen further to the right by a robot that turned to the left.
  if (is_comparable) Vote(same_laser->scan, scan, -std::lround(beams));
  *same_laser = std::move(now);
}

void TurnCheck::Vote(const LaserScan& before, const LaserScan& now, long shift) {
  const std::optional<double> with_m = DifferenceAt(before, now, shift);
  const std::optional<double> against_m = DifferenceAt(before, now, -shift);
  if (!with_m || !against_m) return;
  if (*with_m < kClearly * *against_m) ++votes_with_;
  if (*against_m < kClearly * *with_m) ++votes_against_;
}

bool TurnCheck::turns_against_odometry() const {
  return votes_against_ >= kLeastVotes && votes_against_ > kMajority * votes_with_;
}

}  // namespace qwsm
