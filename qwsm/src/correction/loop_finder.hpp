// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "loop_agreement.hpp"
#include "pose_estimate.hpp"
#include "qwsm/correction/loop.hpp"
#include "scan_chain.hpp"

namespace qwsm {

/// Recognises places: matches each scan with the submaps of earlier passes that it may have come
/// near to.
class LoopFinder {
 public:
  /// @param nodes, chain of these nodes: outlive this.
  LoopFinder(const MapperOptions& options, std::span<const ScanNode> nodes, const ScanChain& chain)
      : locator_(options.locator),
        matcher_(options.locator.matcher),
        nodes_(nodes),
        chain_(chain) {}

  /// The loops that are found from there, in the order of scans, then submaps. Their verdicts are
  /// kAccepted where loops of scans near by agree, else kUnconfirmed.
  /// @param last found before; those that were accepted are not looked for again.
  std::vector<Loop> Find(const PoseEstimate& estimate, std::span<const Loop> last) const;

 private:
  // A scan that may be recognised in a submap.
  struct Candidate {
    NodeId node = 0;
    std::size_t submap = 0;
    UncertainPose2 reference_node;  // As it is expected.
    double distance_m = 0.0;
  };

  std::vector<Candidate> NearPasses(const PoseEstimate& estimate, ReferencePoses& references) const;
  void AppendNodesInReach(const RigidSubmap& submap,
                          const PoseEstimate& estimate,
                          std::vector<NodeId>& nodes) const;
  static std::vector<Candidate> NearestOfEachPass(std::span<const Candidate> near);
  const Loop* AcceptedAmong(std::span<const Loop> loops, const Candidate& candidate) const;
  std::vector<FoundLoop> RecogniseAll(std::span<Candidate> candidates,
                                      std::span<const Loop> last) const;
  std::optional<Loop> Recognise(const Candidate& candidate, const SurfaceMap& surfaces) const;
  Eigen::Matrix3d ErrorWithin(const RigidSubmap& submap) const;

  ScanLocatorOptions locator_;
  WeightedScanMatcher matcher_;
  std::span<const ScanNode> nodes_;
  const ScanChain& chain_;
};

}  // namespace qwsm
