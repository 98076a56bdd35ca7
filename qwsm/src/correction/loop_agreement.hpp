// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "qwsm/correction/loop.hpp"
#include "scan_chain.hpp"

namespace qwsm {

/// The poses of submaps' references as seen from each other.
class ReferencePoses {
 public:
  /// @param seen the references of a submap and of all later ones as seen from it; one more submap
  ///             each time, in their order.
  void Add(std::vector<UncertainPose2> seen) { seen_.push_back(std::move(seen)); }
  /// @pre submap <= other
  const UncertainPose2& Between(std::size_t submap, std::size_t other) const {
    return seen_[submap][other - submap];
  }

 private:
  std::vector<std::vector<UncertainPose2>> seen_;
};

/// A loop, and the submap that it comes from.
struct FoundLoop {
  Loop loop;
  std::size_t submap = 0;
};

/// Says of each loop whether others of scans near by agree with it: pairwise consistent
/// measurements (Mangelson et al. 2018). A place that looks like another one does so for a scan or
/// two, or in another place each time.
/// @param loops sorted by the scan; their verdicts are set.
void ConfirmByOthers(std::vector<FoundLoop>& loops,
                     const ReferencePoses& references,
                     const ScanChain& chain);

}  // namespace qwsm
