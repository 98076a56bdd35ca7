// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/joint_correction.hpp"

#include <optional>
#include <utility>

#include "anchored_path.hpp"
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
AnchoredPath Hang(const LastDrive& drive, std::span<const RelevantScan> scans) {
  AnchoredPath path;
  auto next = scans.begin();
  UncertainPose2 map_last;
  for (const StampedAnswer& answer : drive.answers) {
    MappingStep step{.stamp = answer.stamp, .map_robot = answer.map_robot};
    if (next != scans.end() && next->scan.stamp <= answer.stamp) {
      step.relevant = true;
      step.relevant_scan.stamp = next->scan.stamp;
      step.map_relevant = next->map_robot;
      ++next;
    }
    path.Take(step, map_last);
    if (step.relevant) map_last = step.map_relevant;
  }
  return path;
}

Correction Uncorrected(const ScanMap& map) {
  Correction correction;
  for (const RelevantScan& scan : map.scans()) correction.map_node.push_back(scan.map_robot);
  return correction;
}

}  // namespace

JointCorrection CorrectJointly(const ScanMap& map,
                               const LastDrive& last,
                               const MapperOptions& options) {
  if (last.first_scan == map.scans().size()) return {.correction = Uncorrected(map), .map = map};
  MapCorrector corrector(options);
  NodesOfMap nodes(options.motion);
  for (const RelevantScan& scan : map.scans()) {
    corrector.Add(nodes.Next(scan, scan.id == last.first_scan));
  }
  JointCorrection joint;
  joint.correction = corrector.Correct();
  joint.map = corrector.MapAt(joint.correction.map_node);
  const AnchoredPath path = Hang(last, map.scans().subspan(last.first_scan));
  joint.correction.map_robot =
      path.At(std::span(joint.correction.map_node).subspan(last.first_scan));
  return joint;
}

}  // namespace qwsm
