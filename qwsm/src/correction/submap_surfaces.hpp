// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <utility>

#include "qwsm/mapping/free_space.hpp"
#include "qwsm/matching/surface_map.hpp"

namespace qwsm {

/// What the scans of a submap show. Most submaps are matched with only: their likelihood is made
/// when the first search asks for it.
class SubmapSurfaces {
 public:
  /// @param free_space how many scans it keeps the free space of, and with which margins.
  SubmapSurfaces(const SurfaceMapOptions& options, const FreeSpaceOptions& free_space)
      : surfaces_(SurfaceMap::ForMatching(options)), seen_free_(free_space) {}

  void Insert(const MapPoint& point, ScanId scan) {
    surfaces_.Insert(point, scan);
    likelihood_.reset();
  }

  /// Adds the free space that a scan of the submap saw.
  void SeeFree(const LaserScan& scan, const Pose2& T_chain_robot) {
    seen_free_.Add(scan, T_chain_robot);
  }
  /// Share of the points that end in free space. @param T_chain_robot pose they were seen from.
  double ShareSeenThrough(std::span<const ScanPoint> points, const Pose2& T_chain_robot) const;

  const SurfaceMap& surfaces() const { return surfaces_; }
  const LikelihoodPyramid& likelihood();

 private:
  SurfaceMap surfaces_;
  FreeSpace seen_free_;
  std::optional<LikelihoodPyramid> likelihood_;
};

/// The surfaces of the submaps that were asked for last: a robot stays near the same ones for a
/// while. Those of all submaps of a long drive would be several times the map.
class RecentSurfaces {
 public:
  /// A submap, which may still grow, as it is.
  struct Key {
    std::size_t submap = 0;
    std::size_t scans = 0;

    friend bool operator==(const Key&, const Key&) = default;
  };

  /// @return the surfaces of a submap, valid until the next call.
  /// @param make makes them, where they are not kept.
  SubmapSurfaces& Of(const Key& submap, const std::function<SubmapSurfaces()>& make);

 private:
  std::list<std::pair<Key, SubmapSurfaces>> kept_;  // The last one that was used first.
};

}  // namespace qwsm
