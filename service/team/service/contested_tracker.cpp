// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/contested_tracker.hpp"

#include <algorithm>
#include <utility>

namespace qwsm::team {
namespace {

using Verdict = TrackingTrial::Verdict;

constexpr std::size_t kMostClaims = 64;  // More than any robot's lasers give reason for.

}  // namespace

void ContestedTracker::PlaceAt(const UncertainPose2& map_robot,
                               const std::optional<Pose2>& T_odom_robot) {
  trial_.reset();
  claimed_.reset();
  explained_share_ = 0.0;
  tracker_.PlaceAt(map_robot, T_odom_robot);
}

void ContestedTracker::PlaceAsTold(const UncertainPose2& map_robot) {
  if (trial_ && !claimed_) {
    trial_->BeginAnew();
  } else {
    trial_.reset();
    claimed_.reset();
    // Where it is not tracked, there is nothing to go back to.
    if (explained_share_ > 0.0) trial_.emplace(tracker_, explained_share_);
  }
  tracker_.PlaceAt(map_robot);
}

void ContestedTracker::SuspectOdometryReset() {
  tracker_.SuspectOdometryReset();
  if (trial_) trial_->SuspectOdometryReset();
}

void ContestedTracker::FollowCorrection(const UncertainPose2& map_robot) {
  const Pose2 T_new_old = map_robot.T_a_b * tracker_.map_robot().T_a_b.Inverse();
  tracker_.FollowCorrection(map_robot);
  if (trial_) trial_->FollowCorrection(T_new_old);
}

std::optional<Pose2> ContestedTracker::Mount(LaserScan& scan,
                                             const std::optional<Pose2>& claimed,
                                             bool is_tracked) {
  Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  if (!claimed) return std::nullopt;
  const auto known = std::ranges::find_if(settled_, [&](const Mounting& mounting) {
    return mounting.T_robot_laser == T_robot_laser && mounting.claimed == *claimed;
  });
  if (known == settled_.end() && is_tracked && settled_.size() < kMostClaims) return claimed;
  if (known == settled_.end() && !is_tracked) {
    settled_.push_back({.T_robot_laser = T_robot_laser, .claimed = *claimed, .is_believed = true});
    T_robot_laser = *claimed;
  } else if (known != settled_.end() && known->is_believed) {
    T_robot_laser = *claimed;
  }
  return std::nullopt;
}

ContestedTracker::Tracked ContestedTracker::Track(const ScanMap& map,
                                                  const Observation& observation,
                                                  const std::optional<Pose2>& claimed) {
  const bool is_new = Contest(claimed, observation.scan.geometry.T_robot_laser);
  TrackedScan scan = tracker_.Track(map, observation);
  Tracked tracked{.step = std::move(scan.step), .points = std::move(scan.points)};
  const Verdict verdict = trial_ ? Hear(map, observation, tracked.step) : Verdict::kRivalFails;
  const bool is_place_open = trial_ && !claimed_ && verdict == Verdict::kOpen;
  if (is_place_open) tracked.step.relevant = false;
  if (trial_ && verdict != Verdict::kOpen) {
    tracked.news = Settle(verdict == Verdict::kRivalTakesOver, tracked);
  } else if (!is_place_open) {
    // Whoever claims things of the laser does not keep the map from growing.
    AddRelevant(tracked.step, tracked.relevant);
  }
  explained_share_ = ExplainedShare(tracked.step);
  if (is_new && tracked.news == News::kNone) tracked.news = News::kMountingContested;
  return tracked;
}

/// Whether a claim about the laser begins a trial. One about the robot comes first, and so does one
/// about another laser.
bool ContestedTracker::Contest(const std::optional<Pose2>& claimed, const Pose2& T_robot_laser) {
  if (trial_ && !(claimed_ && T_robot_laser == T_robot_laser_)) return false;
  if (claimed == claimed_ || explained_share_ == 0.0) return false;
  claimed_ = claimed;
  T_robot_laser_ = T_robot_laser;
  trial_.reset();
  if (claimed) trial_.emplace(tracker_, explained_share_);
  return claimed.has_value();
}

TrackingTrial::Verdict ContestedTracker::Hear(const ScanMap& map,
                                              const Observation& observation,
                                              const MappingStep& step) {
  const bool is_contested = claimed_ && observation.scan.geometry.T_robot_laser == T_robot_laser_;
  if (!is_contested) return trial_->Hear(map, observation, step);
  Observation as_claimed = observation;
  as_claimed.scan.geometry.T_robot_laser = *claimed_;
  return trial_->Hear(map, as_claimed, step);
}

ContestedTracker::News ContestedTracker::Settle(bool is_rival_right, Tracked& tracked) {
  if (is_rival_right) {
    tracked.step = trial_->of_rival().step;
    tracked.points = trial_->of_rival().points;
    tracked.relevant = trial_->held_by_rival();
    tracker_ = trial_->rival();
  } else if (claimed_) {
    AddRelevant(tracked.step, tracked.relevant);
  } else {
    tracked.relevant = trial_->held();
  }
  trial_.reset();
  if (!claimed_) return is_rival_right ? News::kPlaceContradicted : News::kNone;
  settled_.push_back(
      {.T_robot_laser = T_robot_laser_, .claimed = *claimed_, .is_believed = is_rival_right});
  claimed_.reset();
  return is_rival_right ? News::kMountingChanged : News::kMountingRefuted;
}

}  // namespace qwsm::team
