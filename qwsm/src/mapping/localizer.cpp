// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/localizer.hpp"

#include <utility>

namespace qwsm {
namespace {

MapperOptions Extending(MapperOptions options) {
  options.extend_map = true;
  return options;
}

}  // namespace

Localizer::Localizer(const MapperOptions& options,
                     ScanMap map,
                     const std::optional<UncertainPose2>& start)
    : options_(options),
      map_(std::move(map)),
      tracker_(options),
      finder_(options),
      watch_(options.free_space) {
  start ? tracker_.PlaceAt(*start) : Lose();
}

MappingStep Localizer::Process(const Observation& observation) {
  if (local_) return Search(observation, ToPoints(observation.scan));
  const Observation still = slip_.Mended(observation);
  const std::vector<ScanPoint> points = ToPoints(still.scan);
  const MappingStep step = tracker_.Track(map_, still, points);
  slip_.Learn(still, step);
  Extend(step);
  if (watch_.Look(map_, points, step) == PlaceDoubt::kLost) Lose();
  return step;
}

MappingStep Localizer::Search(const Observation& observation, std::span<const ScanPoint> points) {
  MappingStep step = local_->Process(observation);
  const PlaceBelief& belief = finder_.Look(map_, points, step.map_robot.T_a_b);
  if (belief.verdict == PlaceVerdict::kFound) return Found(observation, points);
  step.status = StepStatus::kLost;
  step.reason = Name(belief.verdict);
  step.relevant = false;
  return step;
}

// Where the robot drove while it was lost it was as sure of its way as ever, only not of the begin.
MappingStep Localizer::Found(const Observation& observation, std::span<const ScanPoint> points) {
  const Mapper local = std::move(*local_);
  local_.reset();
  watch_.BeginAnew();
  tracker_.PlaceAt(finder_.belief().places.front().map_robot);
  const MappingStep step = tracker_.Track(map_, observation, points);
  map_local_ = step.map_robot * UncertainPose2{.T_a_b = local.map_robot().T_a_b.Inverse()};
  if (options_.extend_map) Join(local.map());
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

void Localizer::Lose() {
  local_.emplace(Extending(options_));
  slip_.Interrupt();
  finder_ = PlaceFinder(options_);
}

}  // namespace qwsm
