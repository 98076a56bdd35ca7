// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/self_correcting_mapper.hpp"

#include <utility>

#include "anchored_path.hpp"
#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {

SelfCorrectingMapper::SelfCorrectingMapper(const MapperOptions& options, WorkBeside beside)
    : mapper_(options),
      corrector_(options, std::move(beside)),
      path_(std::make_unique<AnchoredPath>()) {}

SelfCorrectingMapper::~SelfCorrectingMapper() = default;

MappingStep SelfCorrectingMapper::Process(const Observation& observation) {
  if (corrector_.IsLookDue()) {
    if (auto corrected = corrector_.LookAgain()) {
      GoOnIn(std::move(*corrected), observation.scan.stamp);
    }
  }
  MappingStep step = mapper_.Process(observation);
  step.epoch = static_cast<int>(epochs_.size());
  path_->Take(step, nodes_.map_last().value_or(UncertainPose2{}));
  if (auto node = nodes_.Take(step)) corrector_.Add(std::move(*node));
  return step;
}

// The robot keeps its place beside its last relevant scan.
void SelfCorrectingMapper::GoOnIn(CorrectedMap corrected, Timestamp stamp) {
  const UncertainPose2& map_last = corrected.map_node.back();
  mapper_.GoOnIn(std::move(corrected.map),
                 map_last * Since(*nodes_.map_last(), mapper_.map_robot()));
  nodes_.Follow(map_last);
  epochs_.push_back({.stamp = stamp, .map_node = std::move(corrected.map_node)});
}

Correction SelfCorrectingMapper::Correct() {
  Correction correction = corrector_.Correct();
  correction.map_robot = path_->At(correction.map_node);
  return correction;
}

}  // namespace qwsm
