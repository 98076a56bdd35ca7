// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "loop_agreement.hpp"

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/place_evidence.hpp"

namespace qwsm {
namespace {

constexpr int kMinAgreeing = 2;
constexpr double kMaxChi2 = 7.815;  // 95 % of right ones are below, for three degrees of freedom.

// Both ways around, from the submap that was made first to the scan that was taken last, lead to
// the same place.
bool Agree(const FoundLoop& a,
           const FoundLoop& b,
           ReferencePoses& references,
           const ScanChains& chains) {
  const UncertainPose2 to_last = chains.Relative(a.loop.edge.to, b.loop.edge.to);
  const UncertainPose2 by_a = MeasuredBy(a.loop.edge) * to_last;
  const UncertainPose2 by_b = MeasuredBy(b.loop.edge);
  const double chi2 =
      a.submap <= b.submap
          ? SquaredMahalanobisDistance(by_a, references.Between(a.submap, b.submap) * by_b)
          : SquaredMahalanobisDistance(references.Between(b.submap, a.submap) * by_a, by_b);
  return chi2 <= kMaxChi2;
}

// Whether the submaps that two loops come from are the same robot's.
bool IsOfOneRobot(const FoundLoop& a, const FoundLoop& b, const ScanChains& chains) {
  return chains.submaps()[a.submap].robot == chains.submaps()[b.submap].robot;
}

// What speaks for a loop: the others of scans near by, and what it tells with those that agree.
struct Support {
  int agreeing = 0;
  int disagreeing = 0;
  double nats = 0.0;

  void Add(const FoundLoop& other, bool agrees) {
    ++(agrees ? agreeing : disagreeing);
    if (agrees) nats += other.nats;
  }
};

bool IsConfirmedBy(const Support& support, const FoundLoop& found) {
  return support.agreeing >= kMinAgreeing && support.agreeing > support.disagreeing &&
         found.nats + support.nats >= NatsAskedOfPlace(found.sigma_m);
}

}  // namespace

std::vector<NodeId> ReferencePoses::From(std::size_t submap) const {
  std::vector<NodeId> references;
  for (const RigidSubmap& later : chains_.submaps().subspan(submap)) {
    references.push_back(later.reference());
  }
  return references;
}

const UncertainPose2& ReferencePoses::Between(std::size_t submap, std::size_t other) {
  std::vector<UncertainPose2>& seen = seen_[submap];
  if (seen.empty()) {
    const std::vector<NodeId> references = From(submap);
    seen = estimate_.SeenFrom(references.front(), references);
  }
  return seen[other - submap];
}

void ConfirmByOthers(std::span<FoundLoop> loops,
                     ReferencePoses& references,
                     const ScanChains& chains) {
  std::vector<Support> support(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (std::size_t j = i + 1; j < loops.size(); ++j) {
      const std::optional<std::size_t> apart =
          chains.TurnsBetween(loops[i].loop.edge.to, loops[j].loop.edge.to);
      if (!apart || *apart > kSamePass) break;
      if (*apart == 0 || !IsOfOneRobot(loops[i], loops[j], chains)) continue;
      const bool agree = Agree(loops[i], loops[j], references, chains);
      support[i].Add(loops[j], agree);
      support[j].Add(loops[i], agree);
    }
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (IsConfirmedBy(support[i], loops[i])) loops[i].loop.verdict = LoopVerdict::kAccepted;
  }
}

}  // namespace qwsm
