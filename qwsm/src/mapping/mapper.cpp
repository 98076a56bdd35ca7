// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/mapper.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {
namespace {

// Whether two scans tell of the same points. Readings that failed are no numbers, which are equal
// to nothing.
bool HaveSamePoints(const LaserScan& a, const LaserScan& b) {
  const auto bits = [](float range_m) { return std::bit_cast<std::uint32_t>(range_m); };
  return a.geometry == b.geometry && std::ranges::equal(a.ranges_m, b.ranges_m, {}, bits, bits);
}

}  // namespace

Mapper::Mapper(const MapperOptions& options) : tracker_(options), map_(options.map) {}

Mapper::Mapper(const MapperOptions& options, ScanMap map, const UncertainPose2& map_robot)
    : tracker_(options), map_(std::move(map)) {
  tracker_.PlaceAt(map_robot);
}

void Mapper::GoOnIn(ScanMap corrected, const UncertainPose2& map_robot) {
  map_ = std::move(corrected);
  tracker_.FollowCorrection(map_robot);
  slip_.Interrupt();
}

void Mapper::PlaceAt(const UncertainPose2& map_robot) {
  tracker_.PlaceAt(map_robot);
  slip_.Interrupt();
}

void Mapper::Extend(const LaserScan& scan, const UncertainPose2& map_robot) {
  map_.Insert(scan, ToPoints(scan), map_robot);
}

// Points that were kept out as others were there already are to be inserted: all begins anew.
void Mapper::ForgetSince(ScanId first) {
  const ScanMap before = std::exchange(map_, ScanMap(map_.options()));
  for (const RelevantScan& scan : before.scans().first(first)) Extend(scan.scan, scan.map_robot);
}

MappingStep Mapper::Process(const Observation& observation) {
  const Observation still = slip_.Mended(observation);
  const std::vector<ScanPoint> points = ToPoints(still.scan);
  const MappingStep step = tracker_.Track(map_, still, points);
  slip_.Learn(still, step);
  if (step.relevant) {
    // The baselines match with the last relevant scan only.
    if (options().matcher != MatcherKind::kQWsm) map_.ForgetPoints();
    // Mostly nothing moved, and the scan that extends the map is the one just taken.
    const bool is_this = HaveSamePoints(step.relevant_scan, still.scan);
    map_.Insert(
        step.relevant_scan, is_this ? points : ToPoints(step.relevant_scan), step.map_relevant);
  }
  return step;
}

}  // namespace qwsm
