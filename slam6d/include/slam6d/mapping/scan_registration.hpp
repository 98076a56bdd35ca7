// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "slam6d/cloud/scan_model.hpp"
#include "slam6d/icp/icp.hpp"
#include "slam6d/mapping/free_space.hpp"
#include "slam6d/mapping/octree_overlap.hpp"

namespace slam6d {

/// When a registration is believed.
struct EvidenceOptions {
  /// Of the places that two scans both tell about, at most this share may be solid for one and air
  /// for the other.
  double max_contradiction = 0.1;
};

template <class Visitor>
void Describe(Visitor& visit, EvidenceOptions& o) {
  visit("max_contradiction",
        o.max_contradiction,
        {.help = "share of points that may stand where the other scan saw nothing but air",
         .min = 0,
         .max = 1});
}

/// How a scan is registered with others.
struct RegistrationOptions {
  IcpOptions icp{};
  OverlapOptions guess{};
  EvidenceOptions evidence{};
};

/// A scan as registrations need it, and where it is.
struct PlacedScan {
  const ScanModel* model;
  const RangeImage* image;
  Pose3 T_map_scan;
};

/// What came of a registration.
struct Registration {
  IcpResult icp;  ///< Its `ref` is the map; its searches are those of all attempts.
  Agreement agreement{};
  /// Whether the pairs hold the pose, within what the guess may be wrong by, and what the scanners
  /// saw of each other's points tells something and does not contradict it.
  bool convinces = false;
  int open_motions = 0;  ///< Of six motions, so many are left to the guess, where it convinces.
};

/// Registers a scan, which is guessed to be at its pose within a covariance, with all references at
/// once (Nüchter et al. 2007, sections 3.2 and 3.3): from the guess; where that does not convince,
/// from where overlapping octrees put it; then from where points, which find together from farther
/// off, put it. Where pairs of a pose that convinces never settle, or leave a motion to the guess,
/// the others are tried as well, and the one that sees most of what the references saw counts.
/// Where the pairs of that one never settle, its covariance covers where the other is, too.
///
/// Departing from Nüchter et al., ICP comes before the octrees: these cost many times as much.
Registration RegisterScan(std::span<const PlacedScan> references,
                          const PlacedScan& cur,
                          const Matrix6d& guess_covariance,
                          const RegistrationOptions& options);

}  // namespace slam6d
