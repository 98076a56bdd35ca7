// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/map_echoes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/matching/mode_search.hpp"

namespace qwsm::team {
namespace {

// More make it slower, not surer.
constexpr std::size_t kMostScansAsked = 16;
constexpr std::size_t kMostScansAskedInOthers = 4;
constexpr std::size_t kMostPoints = 80;  // Likewise, of each scan.
constexpr double kPointSpacing_m = 0.15;
// An echo is so far away, and looked for along the path beyond.
constexpr double kElsewhere_m = 3.0;
constexpr double kAroundPath_m = 1.5;
constexpr double kMinScore = 0.6;
constexpr double kModeMargin = 0.2;  // The best echo of one scan need not be that of all.
// Echoes so near to each other are the same one.
constexpr double kOneEcho_m = 1.0;
constexpr double kOneEcho_rad = 0.2;
constexpr std::size_t kMostEchoes = 5;

struct Echo {
  Pose2 T_map_scans;   // Where the frame of the scans lies.
  double votes = 0.0;  // Scores of the scans that look like that.
};

std::vector<const RelevantScan*> Some(std::span<const RelevantScan* const> scans,
                                      std::size_t at_most) {
  const std::size_t stride = 1 + (scans.size() - 1) / at_most;
  std::vector<const RelevantScan*> some;
  for (std::size_t i = 0; i < scans.size(); i += stride) some.push_back(scans[i]);
  return some;
}

std::vector<FoundPose> Places(const RelevantScan& scan,
                              const ScanMap& map,
                              const ModeSearchArea& area) {
  const std::vector<ScanPoint> points = ThinOut(HitsOf(scan.scan), kPointSpacing_m, kMostPoints);
  return SearchModes(map.surfaces().likelihood(),
                     area,
                     PositionsOf(points),
                     {.min_score = kMinScore, .margin = kModeMargin})
      .modes;
}

std::vector<FoundPose> PlacesElsewhere(const RelevantScan& scan,
                                       const ScanMap& map,
                                       const ModeSearchArea& area) {
  const Eigen::Vector2d here_m = scan.map_robot.T_a_b.translation_m();
  std::vector<FoundPose> places =
      Places(scan, map, area.Without(here_m, kElsewhere_m + kAroundPath_m));
  // A search begins in blocks that are wider than its reach.
  std::erase_if(places, [&](const FoundPose& place) {
    return (place.T_map_robot.translation_m() - here_m).norm() < kElsewhere_m;
  });
  return places;
}

// Whether the scan is seen at nearly the same place by both.
bool IsSameEcho(const Pose2& one, const Pose2& other, const Eigen::Vector2d& p_map_m) {
  return (one * p_map_m - other * p_map_m).norm() < kOneEcho_m &&
         std::abs(NormalizeAngle(one.theta_rad - other.theta_rad)) < kOneEcho_rad;
}

void Vote(const RelevantScan& scan,
          const std::vector<FoundPose>& places,
          std::vector<Echo>& echoes) {
  const Pose2& T_scans_scan = scan.map_robot.T_a_b;
  for (const FoundPose& place : places) {
    const Pose2 T_map_scans = place.T_map_robot * T_scans_scan.Inverse();
    const auto known = std::ranges::find_if(echoes, [&](const Echo& echo) {
      return IsSameEcho(echo.T_map_scans, T_map_scans, T_scans_scan.translation_m());
    });
    if (known == echoes.end()) {
      echoes.push_back({.T_map_scans = T_map_scans, .votes = place.score});
    } else {
      known->votes += place.score;
    }
  }
}

// Where scans are found in a map, as most of those asked agree.
std::vector<Pose2> Elect(std::span<const RelevantScan* const> scans,
                         std::size_t at_most,
                         const ScanMap& map,
                         decltype(Places) find,
                         const std::stop_token& stop) {
  if (scans.empty()) return {};
  const ModeSearchArea area(map.surfaces().likelihood(), PathOf(map), kAroundPath_m);
  std::vector<Echo> echoes;
  for (const RelevantScan* scan : Some(scans, at_most)) {
    if (stop.stop_requested()) break;
    Vote(*scan, find(*scan, map, area), echoes);
  }
  std::ranges::stable_sort(echoes, std::ranges::greater{}, &Echo::votes);
  if (echoes.size() > kMostEchoes) echoes.resize(kMostEchoes);
  std::vector<Pose2> T_map_scans;
  for (const Echo& echo : echoes) T_map_scans.push_back(echo.T_map_scans);
  return T_map_scans;
}

}  // namespace

std::vector<Pose2> FindEchoes(std::span<const RelevantScan* const> scans,
                              const ScanMap& map,
                              const std::stop_token& stop) {
  return Elect(scans, kMostScansAsked, map, PlacesElsewhere, stop);
}

std::vector<Pose2> FindLikenesses(std::span<const RelevantScan* const> scans,
                                  const ScanMap& other,
                                  const std::stop_token& stop) {
  return Elect(scans, kMostScansAskedInOthers, other, Places, stop);
}

}  // namespace qwsm::team
