// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/laser_turns.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <tuple>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/sensor/laser_mountings.hpp"

namespace qwsm {
namespace {

constexpr double kPausePeriods = 2.0;  // Who is silent for longer has paused.
constexpr double kLatePeriods = 1.5;   // Scans come a little later than they should.
// Between scans of two lasers odometry may prove to be far better than between those of one, of
// which it is known to slip now and then.
constexpr double kSmallestScale = 1e-3;

bool HasFoundPose(const MappingStep& step) {
  const bool is_matched =
      step.status == StepStatus::kMatched || step.status == StepStatus::kExtended;
  return is_matched && !step.closed_loop;
}

}  // namespace

UncertainPose2 Fused(const UncertainPose2& a, const UncertainPose2& b) {
  const Eigen::Matrix3d of_b = b.covariance.inverse();
  const Eigen::Matrix3d covariance = (a.covariance.inverse() + of_b).inverse();
  return {.T_a_b = Shifted(a.T_a_b, covariance * of_b * Difference(b.T_a_b, a.T_a_b)),
          .covariance = covariance};
}

LaserTurns::LaserTurns(const MotionNoise& noise) : motion_(noise, kSmallestScale) {}

const LaserTurns::Laser* LaserTurns::Find(const LaserScan& scan) const {
  const auto found = std::ranges::find(lasers_, scan.geometry.T_robot_laser, &Laser::T_robot_laser);
  return found == lasers_.end() ? nullptr : &*found;
}

// The time since the laser's last scan; where it paused, that between two scans of another.
LaserTurns::Duration LaserTurns::PeriodAt(const LaserScan& scan, const Laser& laser) const {
  const Duration own = scan.stamp - laser.stamp;
  if (&laser == &lasers_.back()) return own;
  const Duration other = lasers_.back().period.value_or(own);
  return own > kPausePeriods * other ? other : own;
}

double LaserTurns::ShareOfPeriod(const LaserScan& scan) const {
  const Laser* const laser = Find(scan);
  if (laser == nullptr || laser == &lasers_.back()) return 1.0;
  const Duration period = PeriodAt(scan, *laser);
  if (period <= Duration::zero()) return 1.0;
  return std::clamp((scan.stamp - lasers_.back().stamp) / period, 0.0, 1.0);
}

template <class Visitor>
void LaserTurns::VisitOthers(const Observation& observation, const Visitor& visit) const {
  const LaserScan& scan = observation.scan;
  const Laser* const laser = Find(scan);
  if (laser == nullptr || !observation.T_odom_robot) return;
  const Duration period = PeriodAt(scan, *laser);
  for (const Laser& other : lasers_) {
    const Duration age = scan.stamp - other.stamp;
    const bool is_recent = age >= Duration::zero() && age <= kLatePeriods * period;
    if (&other == laser || !other.look || !is_recent || period <= Duration::zero()) continue;
    const Pose2 motion = other.look->T_odom_robot.Inverse() * *observation.T_odom_robot;
    const double share = std::min(1.0, age / period);
    visit(other.look->map_robot * motion_.AsProved(motion, share), motion, share);
  }
}

std::optional<UncertainPose2> LaserTurns::ToldByOthers(const Observation& observation) const {
  std::optional<UncertainPose2> told;
  VisitOthers(observation, [&](const UncertainPose2& map_robot, const Pose2&, double) {
    told = told ? Fused(*told, map_robot) : map_robot;
  });
  return told;
}

std::optional<Pose2> LaserTurns::LastPoseOf(const LaserScan& scan) const {
  const Laser* const laser = Find(scan);
  if (laser == nullptr || PeriodAt(scan, *laser) < scan.stamp - laser->stamp) return std::nullopt;
  return laser->T_map_robot;
}

std::optional<Pose2> LaserTurns::LastFarPoseOf(const LaserScan& scan) const {
  const Laser* const laser = Find(scan);
  return laser == nullptr ? std::nullopt : laser->T_map_far;
}

bool LaserTurns::take_turns() const {
  if (lasers_.size() < 2) return false;
  const Duration since = lasers_.back().stamp - lasers_[lasers_.size() - 2].stamp;
  return !lasers_.back().period || since <= kLatePeriods * *lasers_.back().period;
}

UncertainPose2 LaserTurns::WithHindsight(const UncertainPose2& map_robot,
                                         const Observation& before) const {
  const Laser& last = lasers_.back();
  if (!last.look || !before.T_odom_robot) return map_robot;
  const Duration since = last.stamp - before.scan.stamp;
  const Duration period = last.period.value_or(since);
  const double share = period > Duration::zero() ? std::min(1.0, since / period) : 1.0;
  const Pose2 back = last.look->T_odom_robot.Inverse() * *before.T_odom_robot;
  return Fused(map_robot, last.look->map_robot * motion_.AsProved(back, share));
}

std::optional<UncertainPose2> LaserTurns::last_look() const {
  if (lasers_.empty() || !lasers_.back().look) return std::nullopt;
  return lasers_.back().look->map_robot;
}

std::optional<LaserTurns::Look> LaserTurns::LookOf(const Observation& observation,
                                                   const MappingStep& step) {
  if (!HasFoundPose(step) || !observation.T_odom_robot) return std::nullopt;
  return Look{.map_robot = ToldAlone(step.match), .T_odom_robot = *observation.T_odom_robot};
}

void LaserTurns::Adapt(const Observation& observation, const Look& look) {
  std::vector<std::tuple<UncertainPose2, Pose2, double>> others;
  VisitOthers(observation, [&](const UncertainPose2& map_robot, const Pose2& motion, double share) {
    others.emplace_back(map_robot, motion, share);
  });
  for (const auto& [map_robot, motion, share] : others) {
    motion_.Adapt(map_robot, look.map_robot, motion, share);
  }
}

void LaserTurns::Move(const Pose2& T_new_old) {
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  for (Laser& laser : lasers_) {
    laser.T_map_robot = T_new_old * laser.T_map_robot;
    if (laser.T_map_far) laser.T_map_far = T_new_old * *laser.T_map_far;
    if (laser.look) laser.look->map_robot = new_old * laser.look->map_robot;
  }
}

void LaserTurns::Note(const Observation& observation, const MappingStep& step, bool is_far) {
  const LaserScan& scan = observation.scan;
  const std::optional<Look> look = LookOf(observation, step);
  if (look) Adapt(observation, *look);
  Laser laser{.T_robot_laser = scan.geometry.T_robot_laser};
  if (const Laser* const known = Find(scan)) {
    laser = *known;
    laser.period = scan.stamp - known->stamp;
    lasers_.erase(lasers_.begin() + (known - lasers_.data()));
  }
  laser.stamp = scan.stamp;
  laser.T_map_robot = step.map_robot.T_a_b;
  if (is_far) laser.T_map_far = step.map_robot.T_a_b;
  laser.look = look;
  if (lasers_.size() == kMostMountings) lasers_.erase(lasers_.begin());
  lasers_.push_back(laser);
}

}  // namespace qwsm
