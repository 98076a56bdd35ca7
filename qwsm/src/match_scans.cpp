// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/match_scans.hpp"

#include "qwsm/mapping/scan_locator.hpp"

namespace qwsm {

MatchResult MatchScans(const LaserScan& reference,
                       const LaserScan& scan,
                       const UncertainPose2& guess) {
  ScanMap map;
  map.Insert(reference, ToPoints(reference), {});
  return ScanLocator().Locate(map, ToPoints(scan), guess);
}

MatchResult MatchScans(const LaserScan& reference,
                       const LaserScan& scan,
                       const Pose2& T_ref_cur_guess) {
  return MatchScans(
      reference, scan, UncertainPose2::WithSigmas(T_ref_cur_guess, kGuessSigma_m, kGuessSigma_rad));
}

}  // namespace qwsm
