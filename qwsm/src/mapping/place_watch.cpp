// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/place_watch.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kWeighSpacing_m = 0.15;
constexpr double kBetweenWeighings_m = 0.5;
// Between two scans that show nearly the same.
constexpr double kSameView_m = 0.25;
constexpr double kSameView_rad = 0.25;
// A wrong pose explains by chance about half of what the right one does: half way between them.
constexpr double kStillExplained = 0.75;
// As convincing as a place has to be to be told from one that looks alike: a chance of 1 in 100.
constexpr double kDoubtedNats = -4.6;
// One in ten thousand millions: a robot in doubt is tracked.
constexpr double kRefutedNats = -23.0;

}  // namespace

PlaceDoubt PlaceWatch::Look(const ScanMap& map,
                            std::span<const ScanPoint> points,
                            const MappingStep& step,
                            const PlaceEvidence::Counts& counts) {
  NoteFall(step);
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  if (!IsDue(T_map_robot)) return Doubt();
  T_map_looked_ = T_map_robot;
  evidence_.ForgetFarFrom(map, T_map_robot);
  MatchResult match = step.match;
  match.T_ref_cur = T_map_robot;
  const PlaceFit fit = evidence_.Weigh(map, ThinOut(points, kWeighSpacing_m), match, counts);
  nats_ = std::min(0.0, nats_ + std::max(0.5 * kRefutedNats, NatsOf(fit)));
  return Doubt();
}

void PlaceWatch::BeginAnew() {
  nats_ = 0.0;
  T_map_last_.reset();
  explained_before_.reset();
}

void PlaceWatch::BeginInAnotherMap() {
  BeginAnew();
  evidence_.Forget();
  T_map_looked_.reset();
}

void PlaceWatch::NoteFall(const MappingStep& step) {
  const bool is_matched =
      step.status == StepStatus::kMatched || step.status == StepStatus::kExtended;
  const double explained = is_matched ? step.match.overlap : 0.0;
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  if (explained_before_) {
    if (explained >= kStillExplained * *explained_before_) explained_before_.reset();
  } else if (T_map_last_ && explained < kStillExplained * explained_) {
    const Pose2 moved = T_map_last_->Inverse() * T_map_robot;
    const bool sees_the_same =
        moved.translation_m().norm() < kSameView_m && std::abs(moved.theta_rad) < kSameView_rad;
    if (sees_the_same) {
      explained_before_ = explained_;
      T_map_looked_.reset();
    }
  }
  T_map_last_ = T_map_robot;
  explained_ = explained;
}

bool PlaceWatch::IsDue(const Pose2& T_map_robot) const {
  if (!T_map_looked_) return true;
  const Pose2 moved = T_map_looked_->Inverse() * T_map_robot;
  return moved.translation_m().norm() >= kBetweenWeighings_m;
}

double PlaceWatch::NatsOf(const PlaceFit& fit) const {
  if (explained_before_) return fit.Nats();
  return map_kind_ == MapKind::kGrowing ? fit.NatsInOwnMap() : fit.NatsWithinMap();
}

PlaceDoubt PlaceWatch::Doubt() const {
  if (nats_ < kRefutedNats) return PlaceDoubt::kLost;
  return nats_ < kDoubtedNats ? PlaceDoubt::kInDoubt : PlaceDoubt::kNone;
}

}  // namespace qwsm
