// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/localizer.hpp"

#include <utility>

namespace qwsm {

Localizer::Localizer(const MapperOptions& options,
                     ScanMap map,
                     const std::optional<UncertainPose2>& start)
    : options_(options),
      map_(std::move(map)),
      tracker_(options),
      watch_(options.free_space) {
  start ? tracker_.PlaceAt(*start) : Lose();
}

MappingStep Localizer::Process(const Observation& observation) {
  if (lost_) return Search(observation);
  const auto [step, points, extends_by_points] = tracker_.Track(map_, observation);
  if (step.relevant && extends_by_points) {
    map_.Insert(step.relevant_scan, points, step.map_relevant);
  } else {
    Extend(step);
  }
  if (watch_.Look(map_, points, step) == PlaceDoubt::kLost) Lose();
  return step;
}

MappingStep Localizer::Search(const Observation& observation) {
  MappingStep step = lost_->Follow(observation);
  lost_->LookFor(map_, observation.scan, step);
  if (lost_->is_found()) return Found(observation);
  return AsLost(std::move(step), lost_->belief());
}

MappingStep Localizer::Found(const Observation& observation) {
  const LostRobot lost = *std::exchange(lost_, std::nullopt);
  found_ = lost.belief();
  watch_.BeginAnew();
  tracker_.PlaceAt(lost.map_found());
  const MappingStep step = tracker_.Track(map_, observation).step;
  map_local_ = lost.FrameFor(step.map_robot);
  if (options_.extend_map) Join(lost.local().map());
  Extend(step);
  return step;
}

void Localizer::Extend(const MappingStep& step) {
  if (!step.relevant) return;
  map_.Insert(step.relevant_scan, ToPoints(step.relevant_scan), step.map_relevant);
}

void Localizer::Join(const ScanMap& local) {
  for (const RelevantScan& scan : local.scans()) {
    map_.Insert(scan.scan, ToPoints(scan.scan), map_local_ * scan.map_robot);
  }
}

void Localizer::Lose() { lost_.emplace(options_); }

}  // namespace qwsm
