// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/pitching_laser.hpp"
#include "sim/scenario.hpp"

/// 3D scans of simulated places, with what odometry says and where they were really taken.
namespace slam6d::test {

/// The kinds of places in which pairs of scans are drawn.
enum class PlaceKind { kYard, kOffice, kCorridor, kStreets, kPark, kRubble };
inline constexpr std::array<std::string_view, 6> kPlaceNames{
    "yard", "office", "corridor", "streets", "park", "rubble"};

/// Stops of a robot with a 3D scanner.
struct Stops3 {
  std::vector<Pose3> T_world_scan;
  std::vector<Pose3> T_odom_scan;  ///< Drifts, and knows nothing of height, roll and pitch.
  std::vector<PointCloud> scans;
};

/// The squared error of a pose over its covariance, per degree of freedom: 1 on average where the
/// covariance is right (NEES).
double NeesOf(const Pose3& pose, const Matrix6d& covariance, const Pose3& truth);

/// A closed loop round a yard between houses: 24 stops, of which the last two are where the first
/// two were. 181 x 256 beams of a scanner like Kurt3D's, 1 cm of noise, 0.2 % of stray points.
Stops3 LoopInYard(std::uint64_t seed);

/// Stops every so many metres on the way through a place of this kind, from anywhere on it, looking
/// along it but for 0.15 rad (1 sigma). 181 x 128 beams.
Stops3 DriveAlong(PlaceKind kind, std::uint64_t seed, int stops, double step_m);

/// Two scans of one place, of which the second shows a part of what the first shows.
struct ScanPair3 {
  Stops3 stops;
  double overlap = 0.0;  ///< Share of the second scan's cubes that the first scan fills as well.
};

/// Draws two places on the way through a place of this kind, facing any way along it, until they
/// overlap by a share between the bounds; nothing if that does not come about.
std::optional<ScanPair3> DrawPair(PlaceKind kind,
                                  std::uint64_t seed,
                                  double least_overlap,
                                  double largest_overlap);

}  // namespace slam6d::test
