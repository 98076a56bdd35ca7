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
constexpr double kAcross_m = 1.0;  // It is not so large that none pass by so far beside it.
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

// What a beam that leads past a place tells of it.
enum class Beam { kTellsNothing, kEndsBefore, kEndsThere, kEndsBehind, kGoesOn };

Beam TellOf(float range_m, const LaserGeometry& geometry, double away_m) {
  switch (StateOf(range_m, geometry)) {
    case BeamState::kInvalid:
      return Beam::kEndsThere;  // What moves has been hidden.
    case BeamState::kMiss:
      return Beam::kGoesOn;
    case BeamState::kTooNear:
      return Beam::kTellsNothing;
    case BeamState::kHit:
      break;
  }
  const double behind_m = static_cast<double>(range_m) - away_m;
  if (behind_m < -kBehind_m) return Beam::kEndsBefore;
  return behind_m < kBehind_m ? Beam::kEndsThere : Beam::kEndsBehind;
}

// What the robots of a map see where that one of the other map was.
void CountSights(const DrawnMap& a,
                 const ScanMap& b,
                 std::span<const ScanId> scans_of_robot_b,
                 const Pose2& T_a_b,
                 int at_most_nobody,
                 SightCounts& counts) {
  for (const RelevantScan& own : a.map.scans()) {
    if (counts.nobody == at_most_nobody) break;
    const std::optional<Pose2> T_b_robot = PoseAt(own.scan.stamp, b, scans_of_robot_b);
    if (!T_b_robot) continue;
    const Pose2 T_own_robot = own.map_robot.T_a_b.Inverse() * T_a_b * *T_b_robot;
    const Sight sight = LookAt(own.scan, T_own_robot.translation_m());
    if (sight == Sight::kSomebody) ++counts.somebody;
    if (sight == Sight::kNobody) ++counts.nobody;
  }
}

}  // namespace

Sight LookAt(const LaserScan& scan, const Eigen::Vector2d& p_robot_m) {
  if (p_robot_m.norm() < kBody_m) return Sight::kNobody;
  const Eigen::Vector2d p_laser_m = scan.geometry.T_robot_laser.Inverse() * p_robot_m;
  const double away_m = p_laser_m.norm();
  const double bearing_rad = std::atan2(p_laser_m.y(), p_laser_m.x());
  const double middle_rad = std::atan2(kMiddle_m, away_m);
  const double across_rad = std::atan2(kAcross_m, away_m);
  int end_there = 0;
  int end_behind = 0;
  bool is_free_to_the_right = false;
  bool is_free_to_the_left = false;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double off_rad = NormalizeAngle(scan.geometry.Bearing(beam) - bearing_rad);
    if (std::abs(off_rad) > across_rad) continue;
    const Beam tells = TellOf(scan.ranges_m[beam], scan.geometry, away_m);
    if (std::abs(off_rad) > middle_rad) {
      const bool is_free = tells == Beam::kEndsBehind || tells == Beam::kGoesOn;
      (off_rad < 0.0 ? is_free_to_the_right : is_free_to_the_left) |= is_free;
      continue;
    }
    if (tells == Beam::kEndsBefore) return Sight::kNothing;
    if (tells == Beam::kEndsThere) ++end_there;
    if (tells == Beam::kEndsBehind) ++end_behind;
  }
  if (end_there == 0 && end_behind >= kMinBeams) return Sight::kNobody;
  const bool stands_free = is_free_to_the_right && is_free_to_the_left;
  const bool is_somebody = end_behind == 0 && end_there >= kMinBeams && stands_free;
  return is_somebody ? Sight::kSomebody : Sight::kNothing;
}

SightCounts CountSights(const DrawnMap& a,
                        const DrawnMap& b,
                        const Pose2& T_a_b,
                        int at_most_nobody) {
  SightCounts counts;
  for (const std::vector<ScanId>& scans : b.scans_of_robots) {
    CountSights(a, b.map, scans, T_a_b, at_most_nobody, counts);
  }
  for (const std::vector<ScanId>& scans : a.scans_of_robots) {
    CountSights(b, a.map, scans, T_a_b.Inverse(), at_most_nobody, counts);
  }
  return counts;
}

}  // namespace qwsm::team
