// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/place_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace qwsm {
namespace {

constexpr double kSeenFrom_m = 10.0;        // Scans farther off see little of what one sees.
constexpr double kForgotten_m = 20.0;       // Of a robot that goes on, scans farther off.
constexpr double kPointsThatTellOne = 3.0;  // As in matching.

// How a point of a scan fares at the right place and at the best wrong one: medians of single scans
// of intel, aces and mit-csail in a map of the other half of each (docs/experiments.md).
struct Fate {
  double if_right;
  double if_wrong;
  double Nats() const { return std::log(if_right / if_wrong); }
};
constexpr Fate kExplained{.if_right = 0.90, .if_wrong = 0.65};
constexpr Fate kUnexplained{.if_right = 0.06, .if_wrong = 0.20};
constexpr Fate kNotContradicted{.if_right = 0.96, .if_wrong = 0.85};
constexpr Fate kSeenThrough{.if_right = 0.04, .if_wrong = 0.15};

}  // namespace

double PlaceFit::Nats() const {
  const double unexplained = std::max(0.0, 1.0 - explained - seen_through);
  return NatsWithinMap() + told * unexplained * kUnexplained.Nats();
}

double PlaceFit::NatsWithinMap() const {
  return told * (explained * kExplained.Nats() + seen_through * kSeenThrough.Nats());
}

double PlaceFit::NatsInOwnMap() const {
  const double contradicted = std::min(seen_through, 1.0 - explained);
  return told * (explained * kNotContradicted.Nats() + contradicted * kSeenThrough.Nats());
}

double PlaceEvidence::Told(std::span<const ScanPoint> points) {
  return static_cast<double>(points.size()) / kPointsThatTellOne;
}

PlaceFit PlaceEvidence::Weigh(const ScanMap& map,
                              std::span<const ScanPoint> points,
                              const MatchResult& match,
                              const Counts& counts) {
  const bool is_matched =
      match.status == MatchStatus::kConverged || match.status == MatchStatus::kIterationLimit;
  return {.told = Told(points),
          .explained = is_matched ? match.overlap : 0.0,
          .seen_through = ShareSeenThrough(map, points, match.T_ref_cur, counts)};
}

void PlaceEvidence::ForgetFarFrom(const ScanMap& map, const Pose2& T_map_robot) {
  std::erase_if(images_, [&](const auto& image) {
    const Pose2& T_map_scan = map.scans()[image.first].map_robot.T_a_b;
    return (T_map_scan.translation_m() - T_map_robot.translation_m()).norm() > kForgotten_m;
  });
}

double PlaceEvidence::ShareSeenThrough(const ScanMap& map,
                                       std::span<const ScanPoint> points,
                                       const Pose2& T_map_robot,
                                       const Counts& counts) {
  if (points.empty()) return 0.0;
  std::vector<std::uint8_t> marks(points.size(), 0);
  for (const RelevantScan& scan : map.scans()) {
    const Pose2& T_map_scan = scan.map_robot.T_a_b;
    const double apart_m = (T_map_scan.translation_m() - T_map_robot.translation_m()).norm();
    if (apart_m > kSeenFrom_m || (counts && !counts(scan.id))) continue;
    const auto image = images_.try_emplace(scan.id, scan.scan, T_map_scan, options_).first;
    image->second.MarkSeenThrough(points, T_map_robot, marks);
  }
  return static_cast<double>(std::ranges::count(marks, 1)) / static_cast<double>(points.size());
}

}  // namespace qwsm
