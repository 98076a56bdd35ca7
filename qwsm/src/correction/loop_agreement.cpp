// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "loop_agreement.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/place_evidence.hpp"

namespace qwsm {
namespace {

constexpr int kMinAgreeing = 2;
constexpr double kMaxChi2 = 7.815;  // 95 % of right ones are below, for three degrees of freedom.

// Whether the submaps that two loops come from are the same robot's.
bool IsOfOneRobot(const FoundLoop& a, const FoundLoop& b, const ScanChains& chains) {
  return chains.submaps()[a.submap].robot == chains.submaps()[b.submap].robot;
}

// Calls visit(a, b) for all two loops of scans near by, by their places among all: of a long drive
// a list of them would take more room than the loops.
template <class Visit>
void ForEachTwoOfOnePass(std::span<const FoundLoop> loops, const ScanChains& chains, Visit visit) {
  for (std::size_t a = 0; a < loops.size(); ++a) {
    for (std::size_t b = a + 1; b < loops.size(); ++b) {
      const std::optional<std::size_t> apart =
          chains.TurnsBetween(loops[a].loop.edge.to, loops[b].loop.edge.to);
      if (!apart || *apart > kSamePass) break;
      if (*apart > 0 && IsOfOneRobot(loops[a], loops[b], chains)) visit(a, b);
    }
  }
}

// The poses of the references that loops begin at, as seen from each other. Each loop has its own:
// a submap of another robot, which still grew when the loop was found, has another reference since.
class ReferencePoses {
 public:
  // Those between the references of two loops of one pass: of all they would take the square of a
  // long drive's room.
  ReferencePoses(std::span<const FoundLoop> loops,
                 const PoseEstimate& estimate,
                 const ScanChains& chains) {
    ForEachTwoOfOnePass(loops, chains, [&](std::size_t a, std::size_t b) {
      const auto [first, other] = std::minmax(loops[a].loop.edge.from, loops[b].loop.edge.from);
      seen_[first].try_emplace(other);
    });
    for (auto& [first, others] : seen_) {
      std::vector<NodeId> nodes;
      for (const auto& [other, pose] : others) nodes.push_back(other);
      const auto seen = estimate.SeenFrom(first, nodes);
      for (auto next = seen.begin(); auto& [other, pose] : others) pose = *next++;
    }
  }

  // @pre reference <= other, and two loops of one pass begin at them
  const UncertainPose2& Between(NodeId reference, NodeId other) const {
    return seen_.at(reference).at(other);
  }

 private:
  std::map<NodeId, std::map<NodeId, UncertainPose2>> seen_;
};

// Both ways around, from the reference that was taken first to the scan that was taken last, lead
// to the same place.
bool Agree(const FoundLoop& a,
           const FoundLoop& b,
           const ReferencePoses& references,
           const ScanChains& chains) {
  const UncertainPose2 to_last = chains.Relative(a.loop.edge.to, b.loop.edge.to);
  const UncertainPose2 by_a = MeasuredBy(a.loop.edge) * to_last;
  const UncertainPose2 by_b = MeasuredBy(b.loop.edge);
  const NodeId from_a = a.loop.edge.from;
  const NodeId from_b = b.loop.edge.from;
  const double chi2 =
      from_a <= from_b
          ? SquaredMahalanobisDistance(by_a, references.Between(from_a, from_b) * by_b)
          : SquaredMahalanobisDistance(references.Between(from_b, from_a) * by_a, by_b);
  return chi2 <= kMaxChi2;
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

void ConfirmByOthers(std::span<FoundLoop> loops,
                     const PoseEstimate& estimate,
                     const ScanChains& chains) {
  const ReferencePoses references(loops, estimate, chains);
  std::vector<Support> support(loops.size());
  ForEachTwoOfOnePass(loops, chains, [&](std::size_t a, std::size_t b) {
    const bool agree = Agree(loops[a], loops[b], references, chains);
    support[a].Add(loops[b], agree);
    support[b].Add(loops[a], agree);
  });
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (IsConfirmedBy(support[i], loops[i])) loops[i].loop.verdict = LoopVerdict::kAccepted;
  }
}

}  // namespace qwsm
