// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <stop_token>
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
    /// The direction in `a` in which that is known least: along walls that lead on and on.
    Eigen::Vector2d least_known = Eigen::Vector2d::UnitX();
  };

  /// Takes as long as it takes to locate the scans of both that are near the other's. Once it is
  /// stopped what it returns tells nothing.
  Judgement Judge(const ScanMap& a,
                  const ScanMap& b,
                  const UncertainPose2& a_b,
                  const std::stop_token& stop = {}) const;

  /// The same evidence in a building of which the maps show how much alike its places are: the
  /// alternative is one more place like that one in `a` or `b` which is most like what both show
  /// there. Where a map repeats itself, no more of it than it repeats speaks for a place.
  /// To be stopped likewise.
  double NatsAmongEchoes(const ScanMap& a,
                         const ScanMap& b,
                         const UncertainPose2& a_b,
                         const std::stop_token& stop = {}) const;

  /// Where a third map shows what `b` shows of `a`: the third in `b`. It may lie in `a` in its
  /// stead. To be stopped likewise.
  std::vector<Pose2> InSteadOf(const ScanMap& b,
                               const ScanMap& a,
                               const UncertainPose2& a_b,
                               const ScanMap& third,
                               const std::stop_token& stop = {}) const;

 private:
  // The scans of two maps near each other's.
  struct Overlap {
    std::vector<const RelevantScan*> of_a;
    std::vector<const RelevantScan*> of_b;
  };
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
  // A place that fits best.
  struct Fitted {
    UncertainPose2 a_b;
    Eigen::Vector2d least_known;
  };
  struct Share;
  // What is to be explained, and how it would be if the maps went together.
  struct Evidence;

  Evidence EvidenceOf(const ScanMap& a,
                      const ScanMap& b,
                      const UncertainPose2& a_b,
                      const std::stop_token& stop) const;
  Fates FatesOfBoth(const Overlap& overlap,
                    const ScanMap& map,
                    const UncertainPose2& map_a,
                    const UncertainPose2& map_b,
                    const std::stop_token& stop) const;
  Fates FatesOf(std::span<const RelevantScan* const> scans,
                const ScanMap& map,
                const UncertainPose2& map_scans,
                const std::stop_token& stop) const;
  static Pair PairOf(const Pose2& T_map_scan, const MatchResult& match);
  static Fitted Fit(const UncertainPose2& a_b,
                    std::span<const Pair> b_in_a,
                    std::span<const Pair> a_in_b);

  ScanLocator locator_;
  FreeSpaceOptions free_space_;
};

/// The same, seen from the other frame.
UncertainPose2 Inverse(const UncertainPose2& a_b);

}  // namespace qwsm::team
