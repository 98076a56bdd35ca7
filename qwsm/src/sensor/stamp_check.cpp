// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/stamp_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qwsm {
namespace {

constexpr std::size_t kBeamsLookedAt = 180;  // Of a dense scan some are enough.
constexpr double kWidestTurn_rad = 0.4;      // Between two scans.
constexpr std::size_t kLeastShared = 40;     // Beams.
constexpr double kEdge_m = 0.5;              // Edges are not to outweigh walls.
constexpr double kPoorFit_m = 0.15;          // Scans that differ more have little in common.
constexpr double kLongestPause_s = 0.5;
constexpr double kMostOffset_s = 1.0;
constexpr double kStep_s = 0.01;
constexpr double kLeastTime_s = 6.0 * kMostOffset_s;  // A third of it is compared at all offsets.
constexpr std::size_t kLeastTurnsCompared = 20;  // Of fewer, chance tells which offset is best.
constexpr double kLeastOffset_s = 0.04;   // Less is within what scans take, and hardly matters.
constexpr double kMuchBetter = 0.7;       // The errors are so much less with the offset.
constexpr double kLeastTurned_rad = 6.0;  // By odometry, in all: to and fro or around.
constexpr std::size_t kMostScans = 2000;

// Mean difference of readings, those of `now` being so many looked-at beams further than before.
double MeanDifference(const LaserScan& before, const LaserScan& now, long shift, long stride) {
  double sum_m = 0.0;
  std::size_t shared = 0;
  const auto size = static_cast<long>(before.size());
  for (long i = 0; i < size; i += stride) {
    const long k = i + shift * stride;
    if (k < 0 || k >= size) continue;
    const float a_m = before.ranges_m[static_cast<std::size_t>(i)];
    const float b_m = now.ranges_m[static_cast<std::size_t>(k)];
    if (StateOf(a_m, before.geometry) != BeamState::kHit) continue;
    if (StateOf(b_m, now.geometry) != BeamState::kHit) continue;
    sum_m += std::min(kEdge_m, static_cast<double>(std::abs(a_m - b_m)));
    ++shared;
  }
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  return shared < kLeastShared ? kNothing : sum_m / static_cast<double>(shared);
}

// The turn at which two scans differ least, between beams by the slopes on both sides.
std::optional<double> TurnBetween(const LaserScan& before, const LaserScan& now) {
  const auto stride = static_cast<long>(std::max<std::size_t>(1, before.size() / kBeamsLookedAt));
  const double step_rad =
      static_cast<double>(before.geometry.bearing_step_rad) * static_cast<double>(stride);
  if (before.size() != now.size() || step_rad == 0.0) return std::nullopt;
  const long beams = static_cast<long>(now.size()) / stride;
  const long widest = std::min(beams, std::lround(kWidestTurn_rad / std::abs(step_rad)) + 1);
  std::vector<double> differences_m;
  for (long shift = -widest; shift <= widest; ++shift) {
    differences_m.push_back(MeanDifference(before, now, shift, stride));
  }
  const auto best = std::ranges::min_element(differences_m);
  const bool is_inside = best != differences_m.begin() && best + 1 != differences_m.end();
  if (!is_inside || !(*best < kPoorFit_m)) return std::nullopt;
  const double left_m = *(best - 1) - *best;
  const double right_m = *(best + 1) - *best;
  const double more = std::max(left_m, right_m);
  if (!(more > 0.0) || !std::isfinite(more)) return std::nullopt;
  const double shift =
      static_cast<double>(best - differences_m.begin() - widest) + 0.5 * (left_m - right_m) / more;
  return -shift * step_rad;  // What stands still is seen further to the right after a left turn.
}

}  // namespace

void StampCheck::Add(const LaserScan& scan, const std::optional<Pose2>& T_odom_robot) {
  if (offset_s_ || headings_.size() >= kMostScans || !T_odom_robot || scan.size() < kLeastShared) {
    return;
  }
  if (last_ && last_->geometry.T_robot_laser != scan.geometry.T_robot_laser) return;
  Heading now{.time_s = Seconds(scan.stamp), .by_odometry_rad = 0.0, .turn_by_scan_rad = {}};
  if (last_) {
    const Heading& before = headings_.back();
    if (now.time_s <= before.time_s) return;
    now.by_odometry_rad =
        before.by_odometry_rad + NormalizeAngle(T_odom_robot->theta_rad - last_theta_rad_);
    if (now.time_s - before.time_s < kLongestPause_s) {
      now.turn_by_scan_rad = TurnBetween(*last_, scan);
    }
  }
  headings_.push_back(now);
  last_ = scan;
  last_theta_rad_ = T_odom_robot->theta_rad;
  if (headings_.size() < next_look_) return;
  next_look_ *= 2;
  Judge();
}

// The heading that odometry told at a time; nothing beyond what is known, and in pauses.
std::optional<double> StampCheck::OdometryAt(double time_s) const {
  const auto after = std::ranges::lower_bound(headings_, time_s, {}, &Heading::time_s);
  if (after == headings_.begin() || after == headings_.end()) return std::nullopt;
  const Heading& before = *(after - 1);
  const double step_s = after->time_s - before.time_s;
  if (step_s > kLongestPause_s) return std::nullopt;
  const double share = (time_s - before.time_s) / step_s;
  return before.by_odometry_rad + share * (after->by_odometry_rad - before.by_odometry_rad);
}

// Mean difference of the turns by scans and by odometry, were the scans so much later; infinite
// where too few are known. Not squared: one jump of odometry, which some offset divides between two
// scans, is not to outweigh the drive.
double StampCheck::ErrorAt(double offset_s) const {
  double sum_rad = 0.0;
  std::size_t turns = 0;
  for (std::size_t i = 1; i < headings_.size(); ++i) {
    const Heading& now = headings_[i];
    // The same pairs at every offset.
    const bool is_inner = now.time_s - headings_.front().time_s > 2.0 * kMostOffset_s &&
                          headings_.back().time_s - now.time_s > 2.0 * kMostOffset_s;
    if (!now.turn_by_scan_rad || !is_inner) continue;
    const auto from_rad = OdometryAt(headings_[i - 1].time_s + offset_s);
    const auto to_rad = OdometryAt(now.time_s + offset_s);
    if (!from_rad || !to_rad) continue;
    sum_rad += std::abs(*now.turn_by_scan_rad - (*to_rad - *from_rad));
    ++turns;
  }
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  return turns < kLeastTurnsCompared ? kUnknown : sum_rad / static_cast<double>(turns);
}

void StampCheck::Judge() {
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < headings_.size(); ++i) {
    turned_rad += std::abs(headings_[i].by_odometry_rad - headings_[i - 1].by_odometry_rad);
  }
  const double time_s = headings_.back().time_s - headings_.front().time_s;
  const double as_told_rad = ErrorAt(0.0);
  if (turned_rad < kLeastTurned_rad || time_s < kLeastTime_s || !std::isfinite(as_told_rad)) return;
  const int steps = static_cast<int>(std::lround(kMostOffset_s / kStep_s));
  double best_s = 0.0;
  double least_rad = std::numeric_limits<double>::infinity();
  for (int step = -steps; step <= steps; ++step) {
    const double error_rad = ErrorAt(step * kStep_s);
    if (error_rad >= least_rad) continue;
    least_rad = error_rad;
    best_s = step * kStep_s;
  }
  const bool is_inside = std::abs(best_s) < kMostOffset_s - 0.5 * kStep_s;
  if (is_inside && std::abs(best_s) >= kLeastOffset_s && least_rad < kMuchBetter * as_told_rad) {
    offset_s_ = best_s;
  }
}

}  // namespace qwsm
