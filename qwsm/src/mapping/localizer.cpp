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
  TrackedScan tracked = tracker_.Track(map_, observation);
  Extend(tracked);
  if (watch_.Look(map_, tracked.points, tracked.step) == PlaceDoubt::kLost) Lose();
  return std::move(tracked.step);
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
  TrackedScan tracked = tracker_.Track(map_, observation);
  map_local_ = lost.FrameFor(tracked.step.map_robot);
  if (options_.extend_map) Join(lost.local().map());
  Extend(tracked);
  return std::move(tracked.step);
}

void Localizer::Extend(const TrackedScan& tracked) {
  const MappingStep& step = tracked.step;
  if (!step.relevant) return;
  map_.Insert(step.relevant_scan, tracked.RelevantPoints(), step.map_relevant);
}

void Localizer::Join(const ScanMap& local) {
  for (const RelevantScan& scan : local.scans()) {
    map_.Insert(scan.scan, map_local_ * scan.map_robot);
  }
}

void Localizer::Lose() { lost_.emplace(options_); }

}  // namespace qwsm
