// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "qwsm/mapping/robot_tracker.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::team {

/// Somebody says of a robot that is tracked what does not go with that: that it is somewhere else,
/// or that its laser sits elsewhere. Both may be true, so the robot is followed by two trackers
/// until its scans have told which is right. The rival takes over where it explains them as before
/// and better than the other. Where the scans do not tell, as in rooms that are alike, it does not.
///
/// The evidence is a sequential test (Wald 1945): by how many points more the one explains the
/// scans than the other, until that is as many as a whole scan can tell.
class TrackingTrial {
 public:
  enum class Verdict { kOpen, kRivalFails, kRivalTakesOver };

  /// Begins a trial of a rival.
  /// @param overlap of the robot's last match, before anything was said.
  TrackingTrial(RobotTracker rival, double overlap) : rival_(std::move(rival)), overlap_(overlap) {}

  /// Expects that odometry may have begun anew; see RobotTracker.
  void SuspectOdometryReset() { rival_.SuspectOdometryReset(); }
  /// Follows a map that was moved around the robot. @param T_new_old the old map's frame in the
  /// new.
  void FollowCorrection(const Pose2& T_new_old);
  /// Says that the tracker beside the rival begins anew. What spoke for the rival still does.
  void BeginAnew();

  /// Weighs the next scan.
  /// @param observation as the rival sees it.
  /// @param step what the other tracker made of it.
  Verdict Hear(const ScanMap& map, const Observation& observation, const MappingStep& step);

  const RobotTracker& rival() const { return rival_; }
  /// What the rival made of the last scan.
  const TrackedScan& of_rival() const { return of_rival_; }

  /// The relevant scans since the trial began, by which the map is to be extended after it; they
  /// have no keys yet.
  const std::vector<TeamScan>& held() const { return held_; }
  const std::vector<TeamScan>& held_by_rival() const { return held_by_rival_; }

 private:
  double EvidenceOf(const MappingStep& step) const;
  bool IsSamePlace(const MappingStep& step) const;

  RobotTracker rival_;
  double overlap_;
  TrackedScan of_rival_;
  // Evidence for the rival, in points; negative: for the other tracker.
  double evidence_points_ = 0.0;
  std::vector<TeamScan> held_;
  std::vector<TeamScan> held_by_rival_;
};

/// Adds the scan that a step has found relevant, without a key.
void AddRelevant(const MappingStep& step, std::vector<TeamScan>& scans);

/// Share of the scan that the map explains; 0 where there is no match.
double ExplainedShare(const MappingStep& step);

}  // namespace qwsm::team
