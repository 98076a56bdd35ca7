// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "pose_estimate.hpp"
#include "qwsm/correction/loop.hpp"
#include "scan_chains.hpp"

namespace qwsm {

/// The poses of submaps' references as seen from each other, computed as they are asked for.
class ReferencePoses {
 public:
  /// @param estimate, chains: outlive this.
  ReferencePoses(const PoseEstimate& estimate, const ScanChains& chains)
      : estimate_(estimate), chains_(chains), seen_(chains.submaps().size()) {}

  /// The references of all submaps from this one on.
  std::vector<NodeId> From(std::size_t submap) const;
  /// Keeps what is known already. @param seen the nodes of From(submap) as seen from the first.
  void Keep(std::size_t submap, std::vector<UncertainPose2> seen) {
    seen_[submap] = std::move(seen);
  }
  /// @pre submap <= other
  const UncertainPose2& Between(std::size_t submap, std::size_t other);

 private:
  const PoseEstimate& estimate_;
  const ScanChains& chains_;
  std::vector<std::vector<UncertainPose2>> seen_;  // Empty where nobody asked.
};

/// A loop, and the submap that it comes from.
struct FoundLoop {
  Loop loop;
  /// Information of the match with the submap's surfaces, along the axes of their chain, without
  /// what they are wrong by.
  Eigen::Matrix3d of_match = Eigen::Matrix3d::Zero();
  std::size_t submap = 0;
  double sigma_m = 0.0;  ///< How far off the scan was expected.
  double nats = 0.0;  ///< What the scan tells for the place, and the submap's free space against.
};

/// Says of each loop whether others of scans near by agree with it: pairwise consistent
/// measurements (Mangelson et al. 2018). A place that looks like another one does so for a scan or
/// two, or in another place each time. With those that agree it has to tell as much as the scan may
/// be off (NatsAskedOfPlace): scans that see the same wall and tree agree at another wall and tree.
/// @param loops sorted by the scan's robot, then the scan; their verdicts are set.
void ConfirmByOthers(std::span<FoundLoop> loops,
                     ReferencePoses& references,
                     const ScanChains& chains);

/// Loops of scans that are further apart do not confirm each other.
inline constexpr std::size_t kSamePass = 16;

}  // namespace qwsm
