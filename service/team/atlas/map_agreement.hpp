// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/scan_locator.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm::team {

/// Judges whether two maps that are drawn of one place go together.
///
/// Places that look alike explain each other's scans nearly as well as themselves; what gives them
/// away are things that stand in one and not in the other, so that points of the one end where the
/// other has seen free space. In a map itself hardly any do, however cluttered the place is, and
/// where two maps go together no more do of one in the other.
class MapAgreement {
 public:
  MapAgreement(const ScanLocatorOptions& locator, const FreeSpaceOptions& free_space)
      : locator_(locator), free_space_(free_space) {}

  struct Judgement {
    /// Evidence in nats (log of the ratio of likelihoods) that the maps go together there, the
    /// alternative being a place that looks alike. Grows with what both have mapped.
    double nats = 0.0;
    UncertainPose2 a_b;  ///< As all that both have mapped fits best.
  };

  Judgement Judge(const ScanMap& a, const ScanMap& b, const UncertainPose2& a_b) const;

 private:
  // By how much a scan of one map is found off in the other, in axes of the other.
  struct Pair {
    Pose2 T_map_scan;  // As predicted.
    Eigen::Vector3d off;
    Eigen::Matrix3d information;
  };
  // What becomes of points about which a map knows something, each of which tells what no other
  // does.
  struct Fates {
    double explained = 0.0;
    double seen_through = 0.0;
    std::vector<Pair> pairs;
    void Add(const Fates& other, double share);
  };

  Fates FatesOf(std::span<const RelevantScan* const> scans,
                const ScanMap& map,
                const UncertainPose2& map_scans) const;
  static Pair PairOf(const Pose2& T_map_scan, const MatchResult& match);
  static UncertainPose2 Fit(const UncertainPose2& a_b,
                            std::span<const Pair> b_in_a,
                            std::span<const Pair> a_in_b);

  ScanLocator locator_;
  FreeSpaceOptions free_space_;
};

/// The same, seen from the other frame.
UncertainPose2 Inverse(const UncertainPose2& a_b);

}  // namespace qwsm::team
