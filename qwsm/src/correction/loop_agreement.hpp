// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "pose_estimate.hpp"
#include "qwsm/correction/loop.hpp"
#include "scan_chains.hpp"

namespace qwsm {

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
/// @param loops sorted by the scan's robot, then the scan; those that are confirmed are accepted.
void ConfirmByOthers(std::span<FoundLoop> loops,
                     const PoseEstimate& estimate,
                     const ScanChains& chains);

/// Loops of scans that are further apart do not confirm each other.
inline constexpr std::size_t kSamePass = 16;

}  // namespace qwsm
