// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "loop_agreement.hpp"
#include "pose_estimate.hpp"
#include "qwsm/correction/loop.hpp"
#include "scan_chains.hpp"

namespace qwsm {

/// What an earlier search came to.
struct LastSearch {
  std::span<const FoundLoop> found;  ///< Those that were accepted are not looked for again.
  /// Scans before were looked for from the same poses: nothing else will be found.
  NodeId end = 0;
};

/// Recognises places: matches each scan with the submaps of earlier passes that it may have come
/// near to.
class LoopFinder {
 public:
  /// @param nodes, chains of these nodes: outlive this, as does `recent`.
  LoopFinder(const MapperOptions& options,
             std::span<const ScanNode> nodes,
             const ScanChains& chains,
             RecentSurfaces& recent)
      : locator_(options.locator),
        matcher_(options.locator.matcher),
        nodes_(nodes),
        chains_(chains),
        recent_(recent) {}

  /// The loops that are found from there, in the order of robots, scans, submaps. Their verdicts
  /// are kAccepted where loops of scans near by agree, else kUnconfirmed.
  /// @param first scan to look for: loops of those before are taken over from the last search.
  std::vector<FoundLoop> Find(NodeId first,
                              const PoseEstimate& estimate,
                              const LastSearch& last) const;

 private:
  // A scan that may be recognised in a submap.
  struct Candidate {
    NodeId node = 0;
    std::size_t submap = 0;
    UncertainPose2 reference_node;  // As it is expected.
    double distance_m = 0.0;
  };
  class NearestOfPasses;

  std::vector<Candidate> NearPasses(NodeId first, const PoseEstimate& estimate) const;
  std::vector<NodeId> NodesInReach(NodeId first,
                                   const RigidSubmap& submap,
                                   const PoseEstimate& estimate) const;
  const FoundLoop* LoopOf(const Candidate& candidate, std::span<const FoundLoop> loops) const;
  std::size_t AddOlder(NodeId first,
                       std::span<const FoundLoop> last,
                       std::vector<FoundLoop>& found) const;
  std::vector<FoundLoop> RecogniseAll(std::span<Candidate> candidates,
                                      const LastSearch& last) const;
  std::optional<FoundLoop> Recognise(const Candidate& candidate, SubmapSurfaces& surfaces) const;
  Eigen::Matrix3d ErrorWithin(const RigidSubmap& submap) const;

  ScanLocatorOptions locator_;
  WeightedScanMatcher matcher_;
  std::span<const ScanNode> nodes_;
  const ScanChains& chains_;
  RecentSurfaces& recent_;
};

}  // namespace qwsm
