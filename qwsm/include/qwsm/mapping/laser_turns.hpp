// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/motion_model.hpp"
#include "qwsm/mapping/observation.hpp"
#include "qwsm/mapping/pose_prediction.hpp"

namespace qwsm {

/// What two estimates of one pose, whose errors have nothing in common, say together.
UncertainPose2 Fused(const UncertainPose2& a, const UncertainPose2& b);
/// A prediction and what else is told of the pose.
inline PosePrediction Fused(const PosePrediction& predicted, const UncertainPose2& told) {
  return {.conservative = Fused(predicted.conservative, told),
          .adapted = Fused(predicted.adapted, told)};
}

/// The lasers of a robot that has several, and what each found last: where the robot is, is what
/// all of them say that scanned within the time between two scans of one.
///
/// Each scan is matched at its own time, and is fused with what the others' last scans told alone,
/// moved along by odometry. What they told is in the answer before as well, from which the scan's
/// pose is predicted: that it counts twice there makes up for odometry that is thought to be worse
/// than it is between two lasers. In what is learned of the motion each scan counts once. A laser
/// that is heard no more is forgotten within a period. Lasers are told apart by where they sit on
/// the robot.
class LaserTurns {
 public:
  explicit LaserTurns(const MotionNoise& noise = {});

  /// The share of the time between two scans of a laser that passed from the last scan of any to
  /// this one; 1 for an only laser.
  double ShareOfPeriod(const LaserScan& scan) const;

  /// The time since the last scan of any; very long where there is none.
  std::chrono::duration<double> SinceLast(const LaserScan& scan) const {
    return empty() ? Duration::max() : scan.stamp - lasers_.back().stamp;
  }

  /// Where the robot is as the others' last scans tell; nothing where there are none.
  std::optional<UncertainPose2> ToldByOthers(const Observation& observation) const;

  /// The pose at the laser's last scan, if that is no longer ago than for others.
  std::optional<Pose2> LastPoseOf(const LaserScan& scan) const;
  /// The pose at its last scan that counted as far enough from the one before.
  std::optional<Pose2> LastFarPoseOf(const LaserScan& scan) const;

  /// Takes a scan, and where it was found to be taken.
  void Note(const Observation& observation, const MappingStep& step, bool is_far);

  /// Whether others scanned since the scan before of the laser that scanned last.
  bool take_turns() const;
  /// Where the robot was at an observation before the last one, as that tells, too.
  UncertainPose2 WithHindsight(const UncertainPose2& map_robot, const Observation& before) const;

  /// The last scan's pose as that scan alone tells it; nothing where it was not matched.
  std::optional<UncertainPose2> last_look() const;

  bool empty() const { return lasers_.empty(); }
  /// Follows a map that was corrected.
  void Move(const Pose2& T_new_old);
  /// Forgets all: the robot was put elsewhere.
  void Clear() { lasers_.clear(); }

 private:
  using Duration = std::chrono::duration<double>;

  /// A pose as a scan alone tells it.
  struct Look {
    UncertainPose2 map_robot;
    Pose2 T_odom_robot;
  };

  struct Laser {
    Pose2 T_robot_laser;
    Timestamp stamp{};  // Of its last scan.
    std::optional<Duration> period{};
    Pose2 T_map_robot{};
    std::optional<Pose2> T_map_far{};
    std::optional<Look> look{};  // Of its last scan, if that was matched.
  };

  static std::optional<Look> LookOf(const Observation& observation, const MappingStep& step);

  const Laser* Find(const LaserScan& scan) const;
  Duration PeriodAt(const LaserScan& scan, const Laser& laser) const;
  /// Calls `visit(pose, motion, share)` for what each other laser told within the period.
  template <class Visitor>
  void VisitOthers(const Observation& observation, const Visitor& visit) const;
  void Adapt(const Observation& observation, const Look& look);

  MotionModel motion_;         // Between scans of different lasers.
  std::vector<Laser> lasers_;  // The one that scanned last is the last.
};

}  // namespace qwsm
