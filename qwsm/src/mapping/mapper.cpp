// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/mapper.hpp"

#include <utility>
#include <vector>

#include "qwsm/sensor/scan_points.hpp"

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

MappingStep Mapper::Process(const Observation& observation) {
  const std::vector<ScanPoint> points = ToPoints(observation.scan);
  const MappingStep step = tracker_.Track(map_, observation, points);
  if (step.relevant) {
    // The baselines match with the last relevant scan only.
    if (options().matcher != MatcherKind::kQWsm) map_.ForgetPoints();
    map_.Insert(step.relevant_scan, ToPoints(step.relevant_scan), step.map_relevant);
  }
  return step;
}

}  // namespace qwsm
