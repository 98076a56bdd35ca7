// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/carry_watch.hpp"

#include <algorithm>
#include <utility>

#include "qwsm/mapping/scan_locator.hpp"

namespace qwsm {
namespace {

constexpr double kBetweenQuestions_m = 0.5;
// From farther away little is seen of what was seen when the view broke.
constexpr int kMostLooks = 10;
// Corridors are alike for longer; but from farther than this a map that drifted contradicts itself.
constexpr int kMostLooksOfFoundPlace = 20;
constexpr double kCarriedNats = -23.0;  // As for PlaceWatch.
// No look suffices, not for a doubt either: somebody may step into the way.
constexpr double kLeastOfALook = 0.5 * kCarriedNats;
// A robot that has drifted may be so far off; scans from near there see what it sees.
constexpr double kOffSigmas = 3.0;
constexpr double kMostOff_m = 15.0;
constexpr double kWitnesses_m = 10.0;
// Who sees so little that no place could be told from another one by it does not notice that it is
// elsewhere: a chance of 1 in 10.
constexpr double kLeastTold = 2.3;

bool TellsOfAPlace(const LaserScan& scan) {
  const double told = PlaceEvidence::ToldBySurfaces(HitsOf(scan));
  return PlaceFit{.told = told, .explained = 1.0}.Nats() >= kLeastTold;
}

// The scans of a map until one of them that were taken near a place, as a map of their own.
ScanMap NearbyBefore(const ScanMap& map,
                     ScanId before,
                     const Eigen::Vector2d& here_m,
                     double reach_m) {
  ScanMap nearby(map.options());
  for (const RelevantScan& scan : map.scans().first(before)) {
    if ((scan.map_robot.T_a_b.translation_m() - here_m).norm() > reach_m) continue;
    nearby.Insert(scan.scan, scan.map_robot);
  }
  return nearby;
}

}  // namespace

PlaceDoubt CarryWatch::Look(const ScanMap& map, const LaserScan& scan, const MappingStep& step) {
  if (!IsAsked(map, scan, step)) return PlaceDoubt::kNone;
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  if (IsAnswered(map, {scan, T_map_robot})) {
    Close();
    return PlaceDoubt::kNone;
  }
  if (IsDue(T_map_robot)) {
    const MutualFit fit = evidence_.WeighBothWays(
        map, {scan, T_map_robot}, static_cast<ScanId>(question_->scans_before));
    question_->T_map_looked = T_map_robot;
    ++question_->looks;
    question_->nats = std::min(0.0, question_->nats + std::max(kLeastOfALook, fit.Nats()));
  }
  if (question_->nats < kCarriedNats) {
    if (question_->is_of_found_place || !HasDrifted(map, scan, step.map_robot)) {
      return PlaceDoubt::kLost;
    }
    Close();
    return PlaceDoubt::kNone;
  }
  const bool is_in_doubt = question_->nats < kLeastOfALook;
  const int most_looks = question_->is_of_found_place ? kMostLooksOfFoundPlace : kMostLooks;
  if (question_->looks > most_looks) Close();
  return is_in_doubt ? PlaceDoubt::kInDoubt : PlaceDoubt::kNone;
}

// Whether the view has broken, now or some scans ago.
bool CarryWatch::IsAsked(const ScanMap& map, const LaserScan& scan, const MappingStep& step) {
  const std::size_t scans_before = std::exchange(scans_, map.scans().size());
  const Pose2 T_map_before = std::exchange(T_map_last_, step.map_robot.T_a_b);
  const double explained_before = view_.explained();
  if (view_.Take(step) && !question_ && TellsOfAPlace(scan)) {
    question_ = {.scans_before = scans_before,
                 .explained_before = explained_before,
                 .T_map_reckoned = T_map_before};
  }
  if (!question_) return false;
  question_->T_map_reckoned = question_->T_map_reckoned * step.odometry_motion.T_a_b;
  return true;
}

// The robot sees again what it saw before, from where its wheels have brought it.
bool CarryWatch::IsAnswered(const ScanMap& map, const ScanAtPlace& placed) const {
  const Question& asked = *question_;
  if (asked.is_of_found_place) return false;
  if (!ViewBreak::IsSameView(asked.T_map_reckoned.Inverse() * placed.T_map_robot)) return false;
  const auto before = static_cast<ScanId>(asked.scans_before);
  return ViewBreak::IsAsBefore(PlaceEvidence::ExplainedBefore(map, placed, before),
                               asked.explained_before);
}

// Whether the map as it was before goes together with the scan as near to the robot as it is known.
bool CarryWatch::HasDrifted(const ScanMap& map,
                            const LaserScan& scan,
                            const UncertainPose2& map_robot) const {
  const double drift_m = std::min(kMostOff_m, kOffSigmas * map_robot.SigmaXY_m());
  const ScanMap nearby = NearbyBefore(map,
                                      static_cast<ScanId>(question_->scans_before),
                                      map_robot.T_a_b.translation_m(),
                                      kWitnesses_m + drift_m);
  if (nearby.empty()) return false;
  const MatchResult match = ScanLocator(options_.locator).Locate(nearby, ToPoints(scan), map_robot);
  const auto all = static_cast<ScanId>(nearby.scans().size());
  return PlaceEvidence(options_.free_space)
             .WeighBothWays(nearby, {scan, match.T_ref_cur}, all)
             .Nats() > 0.0;
}

void CarryWatch::BeginAnew(const ScanMap& map) {
  Close();
  view_.Forget();
  scans_ = map.scans().size();
}

void CarryWatch::Move(const Pose2& T_new_old) {
  view_.Move(T_new_old);
  T_map_last_ = T_new_old * T_map_last_;
  if (!question_) return;
  question_->T_map_reckoned = T_new_old * question_->T_map_reckoned;
  if (question_->T_map_looked) question_->T_map_looked = T_new_old * *question_->T_map_looked;
}

void CarryWatch::AskOfFoundPlace(const ScanMap& map, std::size_t scans_before) {
  BeginAnew(map);
  question_ = {.scans_before = scans_before, .is_of_found_place = true};
}

bool CarryWatch::IsDue(const Pose2& T_map_robot) const {
  const std::optional<Pose2>& T_map_looked = question_->T_map_looked;
  return !T_map_looked ||
         (T_map_looked->Inverse() * T_map_robot).translation_m().norm() >= kBetweenQuestions_m;
}

void CarryWatch::Close() {
  question_.reset();
  evidence_.Forget();
}

}  // namespace qwsm
