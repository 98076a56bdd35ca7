// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/joint_correction.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "qwsm/correction/anchored_path.hpp"
#include "qwsm/mapping/motion_model.hpp"

namespace qwsm {
namespace {

// Successive relevant scans of a drive see much of the same.
constexpr double kMostBetweenScans_m = 3.0;

// Makes nodes of the scans of a map, in their order.
class NodesOfMap {
 public:
  explicit NodesOfMap(const MotionNoise& noise) : noise_(noise) {}

  ScanNode Next(const RelevantScan& scan, bool begins_drive) {
    ScanNode node{.scan = scan.scan,
                  .map_robot = scan.map_robot,
                  .odometry = {},
                  .T_last_node = {},
                  .robot = drive_};
    if (last_ != nullptr) {
      const Pose2 T_last_this = last_->map_robot.T_a_b.Inverse() * scan.map_robot.T_a_b;
      const bool is_gap = scan.scan.stamp < last_->scan.stamp ||
                          T_last_this.translation_m().norm() > kMostBetweenScans_m;
      if (begins_drive || is_gap) {
        node.robot = ++drive_;
      } else {
        node.odometry = AsUncertainAsDriven(T_last_this);
        node.T_last_node = T_last_this;
      }
    }
    last_ = &scan;
    return node;
  }

 private:
  // What the wheels told then is not known: no more than that the robot drove.
  UncertainPose2 AsUncertainAsDriven(const Pose2& T_last_this) const {
    MotionModel model(noise_);
    model.Remember(T_last_this, {});
    return model.Predict(std::nullopt).adapted;
  }

  MotionNoise noise_;
  std::size_t drive_ = 0;
  const RelevantScan* last_ = nullptr;
};

// Hangs the answers of a drive on its scans in the map: each on the last one taken until then.
AnchoredPath Hang(std::span<const StampedAnswer> answers, std::span<const RelevantScan> scans) {
  AnchoredPath path;
  auto next = scans.begin();
  std::optional<UncertainPose2> map_last;
  for (const StampedAnswer& answer : answers) {
    MappingStep step{.stamp = answer.stamp, .map_robot = answer.map_robot};
    if (next != scans.end() && next->scan.stamp <= answer.stamp) {
      step.relevant = true;
      step.relevant_is_before = next->scan.stamp != answer.stamp;
      step.map_relevant = next->map_robot;
      ++next;
    }
    path.Take(step, map_last);
    if (step.relevant) map_last = step.map_relevant;
  }
  return path;
}

MapCorrector CorrectorOf(const ScanMap& map,
                         std::span<const DriveInMap> drives,
                         const MapperOptions& options) {
  MapCorrector corrector(options);
  NodesOfMap nodes(options.motion);
  for (const RelevantScan& scan : map.scans()) {
    const bool begins_drive =
        std::ranges::find(drives, scan.id, &DriveInMap::first_scan) != drives.end();
    corrector.Add(nodes.Next(scan, begins_drive));
  }
  return corrector;
}

Correction Uncorrected(const ScanMap& map) {
  Correction correction;
  for (const RelevantScan& scan : map.scans()) correction.map_node.push_back(scan.map_robot);
  return correction;
}

}  // namespace

JointCorrection CorrectJointly(const ScanMap& map,
                               std::span<const DriveInMap> drives,
                               const MapperOptions& options) {
  const std::size_t scans = map.scans().size();
  const bool is_extended = !drives.empty() && drives.front().first_scan < scans;
  JointCorrection joint;
  if (is_extended) {
    MapCorrector corrector = CorrectorOf(map, drives, options);
    joint.correction = corrector.Correct();
    joint.scans = std::move(corrector).ScansAt(joint.correction.map_node);
  } else {
    joint.correction = Uncorrected(map);
    joint.scans.assign(map.scans().begin(), map.scans().end());
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::size_t first = drives[i].first_scan;
    const std::size_t end = i + 1 < drives.size() ? drives[i + 1].first_scan : scans;
    const AnchoredPath path = Hang(drives[i].answers, map.scans().subspan(first, end - first));
    joint.map_robot.push_back(
        path.At(std::span(joint.correction.map_node).subspan(first, end - first)));
  }
  return joint;
}

}  // namespace qwsm
