// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/joint_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

namespace qwsm::team {
namespace {

// A place is the right one if it is not one that only looks alike, wrong once in twenty of these,
// and if no other one comes near, wrong once in a hundred.
constexpr double kSureNats = 3.0;
constexpr double kLeadNats = 4.6;
// A place is weighed again once the maps have grown by so much, unless it has been refuted.
constexpr double kGrown = 1.1;
constexpr double kRefutedNats = -9.2;
// A robot that is not seen where it would be in view: once in ten it is too low, or too thin; and
// then it always is. Likewise something else may be where it would be. Who is seen by one scan is
// not too low for another one, which sees nobody.
constexpr double kSightNats = 2.3;
constexpr int kMostSights = 4;
// Places so near to each other are the same one.
constexpr double kOnePlace_m = 1.0;
constexpr double kOnePlace_rad = 0.2;
constexpr std::size_t kMostCandidates = 20;
// So far off along walls that lead on and on is another place.
constexpr double kSlid_m = 1.5 * kOnePlace_m;
// Fitted from there, what ends so near to where it was has been told by more than those walls.
constexpr double kBack_m = 0.2;

bool HasGrown(std::size_t scans, std::size_t before) {
  return static_cast<double>(scans) > kGrown * static_cast<double>(before);
}

double SightNats(const DrawnMap& a, const DrawnMap& b, const Pose2& T_a_b) {
  const SightCounts counts = CountSights(a, b, T_a_b, kMostSights);
  return counts.nobody > 0 ? -kSightNats * counts.nobody
                           : kSightNats * std::min(counts.somebody, kMostSights);
}

}  // namespace

bool JointCandidates::IsSamePlace(const Candidate& one, const Candidate& other) {
  const Pose2 apart =
      (one.a_b.T_a_b * other.T_b_robot).Inverse() * (other.a_b.T_a_b * other.T_b_robot);
  return apart.translation_m().norm() < kOnePlace_m && std::abs(apart.theta_rad) < kOnePlace_rad;
}

void JointCandidates::Propose(const UncertainPose2& a_b, const Pose2& T_b_robot) {
  const Candidate proposed{.a_b = a_b, .T_b_robot = T_b_robot};
  const bool is_known = std::ranges::any_of(
      candidates_, [&](const Candidate& known) { return IsSamePlace(known, proposed); });
  if (!is_known) candidates_.push_back(proposed);
}

std::optional<Joint> JointCandidates::Decide(const MapAgreement& agreement,
                                             const DrawnMap& a,
                                             const DrawnMap& b,
                                             std::span<const DrawnMap> others,
                                             const std::stop_token& stop) {
  if (!Weigh(agreement, a, b, stop)) return std::nullopt;
  KeepBest();
  if (!HasLeader()) return std::nullopt;
  Candidate& best = candidates_.front();
  if (best.scans_among_echoes != best.scans) Contest(agreement, a.map, b.map, best, stop);
  const double nats = best.nats_among_echoes + best.sight_nats;
  if (nats < kSureNats) return std::nullopt;
  LookForRivals(agreement, a, b, others, best, stop);
  if (best.has_rival) return std::nullopt;
  // Pairs are better ones where it has been fitted.
  const UncertainPose2 fitted = agreement.Judge(a.map, b.map, best.a_b, stop).a_b;
  if (stop.stop_requested()) return std::nullopt;
  return Joint{.a_b = fitted, .nats = nats};
}

// @return false if it was stopped.
bool JointCandidates::Weigh(const MapAgreement& agreement,
                            const DrawnMap& a,
                            const DrawnMap& b,
                            const std::stop_token& stop) {
  const std::size_t scans = a.map.scans().size() + b.map.scans().size();
  for (Candidate& candidate : candidates_) {
    if (!HasGrown(scans, candidate.scans) || candidate.nats < kRefutedNats) continue;
    WeighOne(agreement, a, b, candidate, stop);
    if (stop.stop_requested()) return false;
    candidate.scans = scans;
  }
  return true;
}

void JointCandidates::WeighOne(const MapAgreement& agreement,
                               const DrawnMap& a,
                               const DrawnMap& b,
                               Candidate& candidate,
                               const std::stop_token& stop) {
  const MapAgreement::Judgement judged = agreement.Judge(a.map, b.map, candidate.a_b, stop);
  candidate.a_b = judged.a_b;
  candidate.nats = judged.nats;
  candidate.least_known = judged.least_known;
  candidate.sight_nats = SightNats(a, b, judged.a_b.T_a_b);
}

// What robots saw of each other tells where one map lies to half a metre: both have to go together.
bool JointCandidates::HasLeader() const {
  if (candidates_.empty() || candidates_.front().Total() < kSureNats) return false;
  if (candidates_.front().nats < 0.0) return false;
  return candidates_.size() == 1 ||
         candidates_.front().Total() - candidates_[1].Total() >= kLeadNats;
}

// Along a wall one place is as right as the next one, and robots think of one of them only. What
// repeats itself in a map may do so once more where nobody has been.
void JointCandidates::Contest(const MapAgreement& agreement,
                              const ScanMap& a,
                              const ScanMap& b,
                              Candidate& candidate,
                              const std::stop_token& stop) {
  candidate.scans_among_echoes = candidate.scans;
  candidate.nats_among_echoes = -std::numeric_limits<double>::infinity();
  for (const double slid_m : {-kSlid_m, kSlid_m}) {
    UncertainPose2 slid = candidate.a_b;
    slid.T_a_b.x_m += slid_m * candidate.least_known.x();
    slid.T_a_b.y_m += slid_m * candidate.least_known.y();
    const MapAgreement::Judgement judged = agreement.Judge(a, b, slid, stop);
    const Pose2 back = candidate.a_b.T_a_b.Inverse() * judged.a_b.T_a_b;
    const bool is_elsewhere = back.translation_m().norm() > kBack_m;
    if (is_elsewhere && candidate.nats - judged.nats < kLeadNats) return;
  }
  candidate.nats_among_echoes = agreement.NatsAmongEchoes(a, b, candidate.a_b, stop);
}

void JointCandidates::LookForRivals(const MapAgreement& agreement,
                                    const DrawnMap& a,
                                    const DrawnMap& b,
                                    std::span<const DrawnMap> others,
                                    Candidate& candidate,
                                    const std::stop_token& stop) {
  std::size_t scans = a.map.scans().size() + b.map.scans().size();
  for (const DrawnMap& third : others) scans += third.map.scans().size();
  if (candidate.others == others.size() && !HasGrown(scans, candidate.scans_among_others)) return;
  const double nats = candidate.Total();
  candidate.has_rival = std::ranges::any_of(others, [&](const DrawnMap& third) {
    return IsRival(agreement, third, a, b, candidate.a_b, nats, stop) ||
           IsRival(agreement, third, b, a, Inverse(candidate.a_b), nats, stop);
  });
  candidate.others = others.size();
  candidate.scans_among_others = scans;
}

// In a building with places that are alike a map is drawn of each, and by all that is drawn either
// may lie in another one; but not both of them, where their robots would have seen each other. Then
// one of them has to lead.
bool JointCandidates::IsRival(const MapAgreement& agreement,
                              const DrawnMap& third,
                              const DrawnMap& a,
                              const DrawnMap& b,
                              const UncertainPose2& a_b,
                              double nats,
                              const std::stop_token& stop) {
  const std::vector<Pose2> in_its_stead = agreement.InSteadOf(b.map, a.map, a_b, third.map, stop);
  return std::ranges::any_of(in_its_stead, [&](const Pose2& T_b_third) {
    if (SightNats(b, third, T_b_third) > -kLeadNats) return false;
    Candidate rival{.a_b = a_b * UncertainPose2{.T_a_b = T_b_third}, .T_b_robot = {}};
    WeighOne(agreement, a, third, rival, stop);
    return nats - rival.Total() < kLeadNats;
  });
}

// Places that have come together are one.
void JointCandidates::KeepBest() {
  std::ranges::stable_sort(candidates_, std::ranges::greater{}, &Candidate::Total);
  std::vector<Candidate> kept;
  for (const Candidate& one : candidates_) {
    const bool is_known = std::ranges::any_of(
        kept, [&](const Candidate& better) { return IsSamePlace(better, one); });
    if (!is_known && kept.size() < kMostCandidates) kept.push_back(one);
  }
  candidates_ = std::move(kept);
}

}  // namespace qwsm::team
