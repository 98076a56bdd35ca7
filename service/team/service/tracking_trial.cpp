// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/tracking_trial.hpp"

#include <algorithm>
#include <cmath>

#include "qwsm/mapping/view_break.hpp"

namespace qwsm::team {
namespace {

// What a robot saw last lies in the map where it was tracked, and flatters that place by so much.
constexpr double kFlattery = 0.1;
// After so many relevant scans that fit both alike nothing is to be expected of the next.
constexpr std::size_t kUndecidedScans = 10;

}  // namespace

void AddRelevant(const MappingStep& step, std::vector<TeamScan>& scans) {
  if (!step.relevant) return;
  TeamScan& scan = scans.emplace_back();
  scan.scan = step.relevant_scan;
  scan.map_robot = step.map_relevant;
  scan.T_odom_robot = step.T_odom_relevant;
}

double ExplainedShare(const MappingStep& step) {
  const bool is_matched =
      step.status == StepStatus::kMatched || step.status == StepStatus::kExtended;
  return is_matched ? step.match.overlap : 0.0;
}

void TrackingTrial::BeginAnew() {
  evidence_points_ = std::max(0.0, evidence_points_);
  held_.clear();
}

void TrackingTrial::FollowCorrection(const Pose2& T_new_old) {
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  rival_.FollowCorrection(new_old * rival_.map_robot());
  for (std::vector<TeamScan>* scans : {&held_, &held_by_rival_}) {
    for (TeamScan& scan : *scans) scan.map_robot = new_old * scan.map_robot;
  }
}

TrackingTrial::Verdict TrackingTrial::Hear(const ScanMap& map,
                                           const Observation& observation,
                                           const MappingStep& step) {
  of_rival_ = rival_.Track(map, observation);
  AddRelevant(step, held_);
  AddRelevant(of_rival_.step, held_by_rival_);
  evidence_points_ += EvidenceOf(step);
  const double whole_scan = rival_.options().locator.search.independent_points;
  if (evidence_points_ > whole_scan) return Verdict::kRivalTakesOver;
  const bool is_decided = evidence_points_ < -whole_scan || IsSamePlace(step) ||
                          std::max(held_.size(), held_by_rival_.size()) >= kUndecidedScans;
  return is_decided ? Verdict::kRivalFails : Verdict::kOpen;
}

double TrackingTrial::EvidenceOf(const MappingStep& step) const {
  const auto most = static_cast<std::size_t>(rival_.options().locator.search.independent_points);
  const auto independent = static_cast<double>(std::min(of_rival_.points.size(), most));
  const double by_rival = ExplainedShare(of_rival_.step);
  if (!ViewBreak::IsAsBefore(by_rival, overlap_)) return -independent * (overlap_ - by_rival);
  const double more = by_rival - ExplainedShare(step);
  return independent * std::max(std::min(more, 0.0), more - kFlattery * by_rival);
}

// To within what a search is sure of, for the robot and for what is a metre away from it.
bool TrackingTrial::IsSamePlace(const MappingStep& step) const {
  if (ExplainedShare(step) == 0.0 || ExplainedShare(of_rival_.step) == 0.0) return false;
  const double sure_m = 3.0 * rival_.options().locator.search_error_m;
  const Pose2 apart = step.map_robot.T_a_b.Inverse() * of_rival_.step.map_robot.T_a_b;
  return apart.translation_m().norm() < sure_m && std::abs(apart.theta_rad) < sure_m;
}

}  // namespace qwsm::team
