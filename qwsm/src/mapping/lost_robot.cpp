// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/lost_robot.hpp"

namespace qwsm {
namespace {

MapperOptions Extending(MapperOptions options) {
  options.extend_map = true;
  return options;
}

}  // namespace

LostRobot::LostRobot(const MapperOptions& options) : local_(Extending(options)), finder_(options) {}

MappingStep LostRobot::Follow(const Observation& observation) {
  return local_.Process(observation);
}

void LostRobot::LookFor(const ScanMap& map, const LaserScan& scan, const MappingStep& step) {
  finder_.Look(map, ToPoints(scan), step.map_robot.T_a_b);
}

// Where it drove it was as sure of its way as ever, only not of the begin.
UncertainPose2 LostRobot::FrameFor(const UncertainPose2& map_robot) const {
  return map_robot * UncertainPose2{.T_a_b = local_.map_robot().T_a_b.Inverse()};
}

MappingStep AsLost(MappingStep step, const PlaceBelief& belief) {
  step.status = StepStatus::kLost;
  step.reason = Name(belief.verdict);
  step.relevant = false;
  return step;
}

}  // namespace qwsm
