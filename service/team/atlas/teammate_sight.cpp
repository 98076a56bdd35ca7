// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/teammate_sight.hpp"

#include <cmath>

namespace qwsm::team {
namespace {

constexpr double kBody_m = 0.3;    // Two robots are not nearer to each other,
constexpr double kMiddle_m = 0.1;  // and beams so near to the middle of one hit it.
constexpr double kBehind_m = 0.5;  // It may be so far from where it is said to be.
constexpr int kMinBeams = 2;

}  // namespace

bool SeesNobodyAt(std::span<const ScanPoint> points, const Eigen::Vector2d& p_robot_m) {
  const double away_m = p_robot_m.norm();
  if (away_m < kBody_m) return true;
  const Eigen::Vector2d there = p_robot_m / away_m;
  int seen_behind = 0;
  for (const ScanPoint& point : points) {
    const double along_m = point.p_robot_m.dot(there);
    const double beside_m = there.x() * point.p_robot_m.y() - there.y() * point.p_robot_m.x();
    // Where the beam passes the place, it may be nearer to its middle than where it ends.
    if (along_m <= 0.0 || std::abs(beside_m) * away_m > kMiddle_m * along_m) continue;
    if (along_m < away_m + kBehind_m) return false;
    ++seen_behind;
  }
  return seen_behind >= kMinBeams;
}

}  // namespace qwsm::team
