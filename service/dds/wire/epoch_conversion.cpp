// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/epoch_conversion.hpp"

#include <cstdint>
#include <cstring>
#include <map>
#include <span>

#include "qwsm/geometry/position.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/scans/component.hpp"
#include "service/team/scans/robot_name.hpp"

namespace qwsm::dds {
namespace {

bool IsTooLong(const char* name) { return strnlen(name, kMaxNameLength + 1) > kMaxNameLength; }

bool IsMapFrame(const char* frame) {
  return !IsTooLong(frame) && team::IsRobotName(team::ComponentOf(frame));
}

std::span<const wire::MovedScan> ScansOf(const wire::MapEpoch& sample) {
  return {sample.scans._buffer, sample.scans._length};
}

}  // namespace

const std::string& EpochSample::FrameOf(const std::string& component) {
  return frames_.try_emplace(component, team::FrameOf(component)).first->second;
}

// As the last scan of each robot is moved.
std::vector<wire::MovedRobot> EpochSample::RobotsOf(const team::TeamEpoch& epoch) {
  std::map<std::string_view, const team::MovedScan*> last;
  for (const team::MovedScan& scan : epoch.scans) last[scan.key.robot] = &scan;
  std::vector<wire::MovedRobot> robots;
  for (const auto& [name, scan] : last) {
    wire::MovedRobot& robot = robots.emplace_back();
    robot.robot = Borrow(scan->key.robot);
    robot.frame_before = Borrow(FrameOf(scan->component_before));
    robot.frame = Borrow(FrameOf(scan->component));
    robot.correction = ToWire2D(scan->map_robot.T_a_b * scan->T_map_robot_before.Inverse());
  }
  return robots;
}

EpochSample::EpochSample(const team::TeamEpoch& epoch) : robots_(RobotsOf(epoch)) {
  for (const team::MovedScan& moved : epoch.scans) {
    wire::MovedScan& scan = scans_.emplace_back();
    scan.origin = Borrow(moved.key.service);
    scan.robot = Borrow(moved.key.robot);
    scan.sequence_number = moved.key.sequence;
    scan.frame_before = Borrow(FrameOf(moved.component_before));
    scan.frame = Borrow(FrameOf(moved.component));
    scan.before = ToWire2D(moved.T_map_robot_before);
    scan.pose = ToWire2D(moved.map_robot.T_a_b);
    CopyCovariance(moved.map_robot.covariance, scan.covariance);
  }
  sample_.header = HeaderOf(epoch.stamp, FrameOf(""));
  sample_.origin = Borrow(epoch.rank.service);
  sample_.number = epoch.rank.number;
  const auto robots = static_cast<std::uint32_t>(robots_.size());
  const auto scans = static_cast<std::uint32_t>(scans_.size());
  sample_.robots = {
      ._maximum = robots, ._length = robots, ._buffer = robots_.data(), ._release = false};
  sample_.scans = {
      ._maximum = scans, ._length = scans, ._buffer = scans_.data(), ._release = false};
}

std::string_view ObjectionTo(const wire::MapEpoch& sample) {
  if (const std::string_view objection = ObjectionTo(sample.header); !objection.empty()) {
    return objection;
  }
  if (*sample.origin == '\0' || IsTooLong(sample.origin)) return "it names no service";
  if (sample.number >= team::kMostEpochs) return "its number is higher than any count";
  for (const wire::MovedScan& scan : ScansOf(sample)) {
    if (IsTooLong(scan.origin) || IsTooLong(scan.robot)) return "a name in it is too long";
    if (!team::IsRobotName(scan.robot)) return "a robot's name in it is no namespace";
    if (!IsMapFrame(scan.frame) || !IsMapFrame(scan.frame_before)) {
      return "a frame in it is no map's";
    }
    const UncertainPose2 pose{.T_a_b = FromWire(scan.pose),
                              .covariance = CovarianceOf(scan.covariance)};
    if (!IsPosition(FromWire(scan.before))) return "a pose in it is no position";
    if (const std::string_view objection = ObjectionTo(pose); !objection.empty()) return objection;
  }
  return {};
}

team::TeamEpoch FromWire(const wire::MapEpoch& sample) {
  team::TeamEpoch epoch{.rank = {.number = sample.number, .service = sample.origin},
                        .stamp = *FromWire(sample.header.stamp),
                        .scans = {}};
  for (const wire::MovedScan& scan : ScansOf(sample)) {
    epoch.scans.push_back(
        {.key = {.service = scan.origin, .robot = scan.robot, .sequence = scan.sequence_number},
         .component = team::ComponentOf(scan.frame),
         .component_before = team::ComponentOf(scan.frame_before),
         .T_map_robot_before = FromWire(scan.before),
         .map_robot = {.T_a_b = FromWire(scan.pose), .covariance = CovarianceOf(scan.covariance)}});
  }
  return epoch;
}

}  // namespace qwsm::dds
