// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/place_watch.hpp"

#include <algorithm>

namespace qwsm {
namespace {

constexpr double kBetweenWeighings_m = 0.5;
// As convincing as a place has to be to be told from one that looks alike: a chance of 1 in 100.
constexpr double kDoubtedNats = -4.6;
// One in ten thousand millions: a robot in doubt is tracked.
constexpr double kRefutedNats = -23.0;

}  // namespace

PlaceDoubt PlaceWatch::Look(const ScanMap& map,
                            std::span<const ScanPoint> points,
                            const MappingStep& step,
                            const PlaceEvidence::Counts& counts) {
  NoteBreak(step);
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  if (!IsDue(T_map_robot)) return Doubt();
  T_map_looked_ = T_map_robot;
  evidence_.ForgetFarFrom(map, T_map_robot);
  MatchResult match = step.match;
  match.T_ref_cur = T_map_robot;
  const PlaceFit fit = evidence_.Weigh(map, PlaceEvidence::OneOfEachSurface(points), match, counts);
  nats_ = std::min(0.0, nats_ + std::max(0.5 * kRefutedNats, NatsOf(fit)));
  return Doubt();
}

void PlaceWatch::BeginAnew() {
  nats_ = 0.0;
  view_.Forget();
  explained_before_.reset();
}

void PlaceWatch::FollowCorrection() {
  BeginAnew();
  T_map_looked_.reset();
}

void PlaceWatch::BeginInAnotherMap() {
  FollowCorrection();
  evidence_.Forget();
}

void PlaceWatch::NoteBreak(const MappingStep& step) {
  const double before = view_.explained();
  const bool breaks = view_.Take(step);
  if (explained_before_) {
    if (ViewBreak::IsAsBefore(view_.explained(), *explained_before_)) explained_before_.reset();
  } else if (breaks) {
    explained_before_ = before;
    T_map_looked_.reset();
  }
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
