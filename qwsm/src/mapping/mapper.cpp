// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/mapper.hpp"

#include <span>
#include <utility>

namespace qwsm {

Mapper::Mapper(const MapperOptions& options) : tracker_(options), map_(options.map) {}

Mapper::Mapper(const MapperOptions& options, ScanMap map, const UncertainPose2& map_robot)
    : tracker_(options), map_(std::move(map)) {
  tracker_.PlaceAt(map_robot);
}

void Mapper::GoOnIn(ScanMap corrected, const UncertainPose2& map_robot) {
  map_ = std::move(corrected);
  tracker_.FollowCorrection(map_robot);
}

void Mapper::PlaceAt(const UncertainPose2& map_robot) { tracker_.PlaceAt(map_robot); }

void Mapper::Extend(const LaserScan& scan, const UncertainPose2& map_robot) {
  map_.Insert(scan, map_robot);
}

// Points that were kept out as others were there already are to be inserted: all begins anew.
void Mapper::ForgetSince(ScanId first) {
  const std::span<const RelevantScan> left = map_.scans().first(first);
  map_ = MapOf({left.begin(), left.end()}, map_.options());
}

MappingStep Mapper::Process(const Observation& observation) {
  TrackedScan tracked = tracker_.Track(map_, observation);
  const MappingStep& step = tracked.step;
  if (step.relevant) {
    // The baselines match with the last relevant scan only.
    if (options().matcher != MatcherKind::kQWsm) map_.ForgetPoints();
    map_.Insert(step.relevant_scan, tracked.RelevantPoints(), step.map_relevant);
  }
  return std::move(tracked.step);
}

}  // namespace qwsm
