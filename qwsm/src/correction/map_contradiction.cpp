// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "map_contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace qwsm {
namespace {

constexpr std::size_t kStep = 4;  // Of so many scans one is asked.
constexpr double kNear_m = 15.0;  // Scans so near to each other look at the same surfaces.
constexpr double kPointSpacing_m = 0.3;
// Of counts that have nothing to do with each other: the same scans are asked before and after, and
// chance makes less of a difference.
constexpr double kMaxSigmas = 1.0;
// It is asked again and again while a robot drives: chance has many tries.
constexpr double kMinSigmas = 5.0;

// A scan that is asked, where it is thought to have been taken.
struct Witness {
  const LaserScan* scan;
  Pose2 T_map_robot;
  FreeRangeImage seen_free;
};

std::vector<Witness> WitnessesAmong(std::span<const ScanNode> nodes,
                                    std::span<const Pose2> T_map_node,
                                    const FreeSpaceOptions& options) {
  std::vector<Witness> witnesses;
  witnesses.reserve(nodes.size() / kStep + 1);
  std::shared_ptr<const BeamsByDirection> beams;
  for (std::size_t i = 0; i < nodes.size(); i += kStep) {
    const LaserScan& scan = nodes[i].scan;
    if (beams && !beams->Fit(scan)) beams = nullptr;
    witnesses.push_back({.scan = &scan,
                         .T_map_robot = T_map_node[i],
                         .seen_free = FreeRangeImage(scan, T_map_node[i], options, beams)});
    beams = witnesses.back().seen_free.beams();
  }
  return witnesses;
}

// Both counts scatter as those of rare events do; one of none might have been one.
double SigmaOfDifference(const Contradiction& a, const Contradiction& b) {
  const auto variance_of_share = [](const Contradiction& c) {
    const double looked_at = std::max(1.0, static_cast<double>(c.looked_at));
    return (static_cast<double>(c.seen_through) + 1.0) / (looked_at * looked_at);
  };
  return std::sqrt(variance_of_share(a) + variance_of_share(b));
}

}  // namespace

double Contradiction::share() const {
  return looked_at == 0 ? 0.0 : static_cast<double>(seen_through) / static_cast<double>(looked_at);
}

bool IsWorse(const Contradiction& after, const Contradiction& before) {
  return after.share() - before.share() > kMaxSigmas * SigmaOfDifference(after, before);
}

bool IsMostlyResolved(const Contradiction& after, const Contradiction& before) {
  return after.share() < 0.5 * before.share() &&
         before.share() - after.share() > kMinSigmas * SigmaOfDifference(after, before);
}

Contradiction ContradictionAt(std::span<const ScanNode> nodes,
                              std::span<const Pose2> T_map_node,
                              const FreeSpaceOptions& options) {
  const std::vector<Witness> witnesses = WitnessesAmong(nodes, T_map_node, options);
  Contradiction contradiction;
  for (const Witness& at : witnesses) {
    const PointColumns points(ThinOut(HitsOf(*at.scan), kPointSpacing_m));
    const RigidTransform2 map_robot(at.T_map_robot);
    std::vector<std::uint8_t> marks(points.size());
    for (const Witness& from : witnesses) {
      const Eigen::Vector2d apart_m =
          from.T_map_robot.translation_m() - at.T_map_robot.translation_m();
      if (&from == &at || apart_m.squaredNorm() > kNear_m * kNear_m) continue;
      std::ranges::fill(marks, 0);
      from.seen_free.MarkSeenThrough(points, map_robot, marks);
      contradiction.looked_at += marks.size();
      contradiction.seen_through += static_cast<std::size_t>(std::ranges::count(marks, 1));
    }
  }
  return contradiction;
}

}  // namespace qwsm
