// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/teammate_sight.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include "qwsm/geometry/angle.hpp"

namespace qwsm::team {
namespace {

constexpr double kBody_m = 0.3;    // Two robots are not nearer to each other,
constexpr double kMiddle_m = 0.1;  // and beams so near to the middle of one hit it.
constexpr double kBehind_m = 0.5;  // It may be so far from where it is said to be.
constexpr int kMinBeams = 2;
// Between two of its scans a robot drives steadily; between those farther apart it may have stood.
constexpr std::chrono::seconds kSteady{3};

// Where a robot was between two of its scans; none where it cannot be told.
std::optional<Pose2> PoseAt(Timestamp stamp,
                            const ScanMap& map,
                            std::span<const ScanId> scans_of_robot) {
  const auto stamp_of = [&](ScanId id) { return map.scans()[id].scan.stamp; };
  const auto next = std::ranges::lower_bound(scans_of_robot, stamp, {}, stamp_of);
  if (next == scans_of_robot.begin() || next == scans_of_robot.end()) return std::nullopt;
  const RelevantScan& before = map.scans()[*std::prev(next)];
  const RelevantScan& after = map.scans()[*next];
  const std::chrono::nanoseconds between = after.scan.stamp - before.scan.stamp;
  if (between > kSteady) return std::nullopt;
  const double share = static_cast<double>((stamp - before.scan.stamp).count()) /
                       static_cast<double>(between.count());
  return Between(before.map_robot.T_a_b, after.map_robot.T_a_b, share);
}

// How often the robots of a map do not see that one of the other map.
int CountUnseen(const DrawnMap& a,
                const ScanMap& b,
                std::span<const ScanId> scans_of_robot_b,
                const Pose2& T_a_b,
                int at_most) {
  int unseen = 0;
  for (const RelevantScan& own : a.map.scans()) {
    if (unseen == at_most) break;
    const std::optional<Pose2> T_b_robot = PoseAt(own.scan.stamp, b, scans_of_robot_b);
    if (!T_b_robot) continue;
    const Pose2 T_own_robot = own.map_robot.T_a_b.Inverse() * T_a_b * *T_b_robot;
    if (SeesNobodyAt(own.scan, T_own_robot.translation_m())) ++unseen;
  }
  return unseen;
}

}  // namespace

bool SeesNobodyAt(const LaserScan& scan, const Eigen::Vector2d& p_robot_m) {
  if (p_robot_m.norm() < kBody_m) return true;
  const Eigen::Vector2d p_laser_m = scan.geometry.T_robot_laser.Inverse() * p_robot_m;
  const double away_m = p_laser_m.norm();
  const double bearing_rad = std::atan2(p_laser_m.y(), p_laser_m.x());
  const double beside_rad = std::atan2(kMiddle_m, away_m);
  int seen_behind = 0;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const float range_m = scan.ranges_m[beam];
    if (StateOf(range_m, scan.geometry) != BeamState::kHit) continue;
    const double off_rad = NormalizeAngle(scan.geometry.Bearing(beam) - bearing_rad);
    if (std::abs(off_rad) > beside_rad) continue;
    if (static_cast<double>(range_m) < away_m + kBehind_m) return false;
    ++seen_behind;
  }
  return seen_behind >= kMinBeams;
}

int CountUnseen(const DrawnMap& a, const DrawnMap& b, const Pose2& T_a_b, int at_most) {
  int unseen = 0;
  for (const std::vector<ScanId>& scans : b.scans_of_robots) {
    unseen += CountUnseen(a, b.map, scans, T_a_b, at_most - unseen);
  }
  for (const std::vector<ScanId>& scans : a.scans_of_robots) {
    unseen += CountUnseen(b, a.map, scans, T_a_b.Inverse(), at_most - unseen);
  }
  return unseen;
}

}  // namespace qwsm::team
