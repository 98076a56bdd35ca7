// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "loop_agreement.hpp"

#include <Eigen/LU>

namespace qwsm {
namespace {

constexpr NodeId kSamePass = 16;  // Nodes between scans of the same pass, at most.
constexpr int kMinAgreeing = 2;
constexpr double kMaxChi2 = 7.815;  // 95 % of right ones are below, for three degrees of freedom.

double SquaredMahalanobisDistance(const UncertainPose2& a, const UncertainPose2& b) {
  const Eigen::Vector3d apart(a.T_a_b.x_m - b.T_a_b.x_m,
                              a.T_a_b.y_m - b.T_a_b.y_m,
                              NormalizeAngle(a.T_a_b.theta_rad - b.T_a_b.theta_rad));
  return apart.dot((a.covariance + b.covariance).inverse() * apart);
}

// Both ways around, from the submap that was made first to the scan that was taken last, lead to
// the same place.
bool Agree(const FoundLoop& a,
           const FoundLoop& b,
           const ReferencePoses& references,
           const ScanChain& chain) {
  const UncertainPose2 to_last = chain.Relative(a.loop.edge.to, b.loop.edge.to);
  const UncertainPose2 by_a = MeasuredBy(a.loop.edge) * to_last;
  const UncertainPose2 by_b = MeasuredBy(b.loop.edge);
  const double chi2 =
      a.submap <= b.submap
          ? SquaredMahalanobisDistance(by_a, references.Between(a.submap, b.submap) * by_b)
          : SquaredMahalanobisDistance(references.Between(b.submap, a.submap) * by_a, by_b);
  return chi2 <= kMaxChi2;
}

}  // namespace

void ConfirmByOthers(std::vector<FoundLoop>& loops,
                     const ReferencePoses& references,
                     const ScanChain& chain) {
  std::vector<int> agreeing(loops.size());
  std::vector<int> disagreeing(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (std::size_t j = i + 1; j < loops.size(); ++j) {
      const NodeId apart = loops[j].loop.edge.to - loops[i].loop.edge.to;
      if (apart > kSamePass) break;
      if (apart == 0) continue;
      std::vector<int>& count =
          Agree(loops[i], loops[j], references, chain) ? agreeing : disagreeing;
      ++count[i];
      ++count[j];
    }
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const bool is_confirmed = agreeing[i] >= kMinAgreeing && agreeing[i] > disagreeing[i];
    loops[i].loop.verdict = is_confirmed ? LoopVerdict::kAccepted : LoopVerdict::kUnconfirmed;
  }
}

}  // namespace qwsm
