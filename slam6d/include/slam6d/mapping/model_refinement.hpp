// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "slam6d/icp/icp.hpp"

namespace slam6d {

/// When and how scans are fitted to each other (Nüchter et al. 2007, section 3.5).
struct RefinementOptions {
  bool enabled = false;
  int min_pairs = 250;           ///< Scans with more pairs overlap: p in section 3.5.
  double max_distance_m = 0.25;  ///< Longer pairs do not count; the poses are good by now.
  int max_neighbors = 8;  ///< A scan is fitted to so many of the nearest scans that overlap it.
  /// A scan that moves less than both tolerances moves no others.
  double translation_tolerance_m = 1e-3;
  double rotation_tolerance_rad = 1e-4;
  int max_visits = 5;  ///< A scan is fitted at most so often.
};

template <class Visitor>
void Describe(Visitor& visit, RefinementOptions& o) {
  visit("enabled", o.enabled, {.help = "fit all scans to each other at the end"});
  visit("min_pairs", o.min_pairs, {.help = "scans with more pairs overlap", .min = 3, .max = 1e9});
  visit("max_distance_m", o.max_distance_m, {.help = "of a pair", .min = 0, .max = 1000});
  visit("max_neighbors",
        o.max_neighbors,
        {.help = "a scan is fitted to the nearest of those it overlaps", .min = 1, .max = 1e6});
  visit("translation_tolerance_m",
        o.translation_tolerance_m,
        {.help = "a scan that moves less lets its neighbours rest", .min = 0, .max = 1});
  visit("rotation_tolerance_rad",
        o.rotation_tolerance_rad,
        {.help = "a scan that moves less lets its neighbours rest", .min = 0, .max = 1});
  visit("max_visits", o.max_visits, {.help = "fits of each scan, at most", .min = 0, .max = 1e6});
}

struct RefinementProgress {
  std::size_t fits = 0;     ///< Fits done so far.
  std::size_t waiting = 0;  ///< Scans in the queue.
};

/// Is told after each fit; ends the refinement by returning false.
using RefinementObserver = std::function<bool(const RefinementProgress&)>;

struct RefinementResult {
  std::vector<Pose3> T_map_scan;
  std::size_t fits = 0;
  bool settled = false;  ///< The queue ran empty: no scan wants to move any more.
};

/// Simultaneous matching (Nüchter et al. 2007, section 3.5, after Pulli 1999): each scan is fitted
/// to all it overlaps, and where it moves, these are fitted again, until nothing moves. The first
/// scan, the master, stays where it is; scans without a model stay out.
///
/// Departing from Nüchter et al., the queue begins with all scans, as one that already fits would
/// hide those behind it; a scan's neighbours are the nearest ones only, so that the time grows with
/// the number of scans and not with its square; and a scan is fitted so many times at most.
RefinementResult RefineModel(std::span<const IcpReference> scans,
                             const IcpOptions& icp,
                             const RefinementOptions& options,
                             const RefinementObserver& observer = {});

/// Whether more than `min_pairs` points of `cur` have a partner in `ref` within a distance in
/// metres.
bool OverlapsByPairs(const ScanModel& ref,
                     const ScanModel& cur,
                     const Pose3& T_ref_cur,
                     const RefinementOptions& options);

}  // namespace slam6d
