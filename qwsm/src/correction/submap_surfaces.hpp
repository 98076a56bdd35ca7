// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <optional>
#include <utility>

#include "qwsm/matching/surface_map.hpp"

namespace qwsm {

/// What the scans of a submap show. Most submaps are matched with only: their likelihood is made
/// when the first search asks for it.
class SubmapSurfaces {
 public:
  explicit SubmapSurfaces(const SurfaceMapOptions& options)
      : surfaces_(SurfaceMap::ForMatching(options)) {}

  void Insert(const MapPoint& point, ScanId scan) {
    surfaces_.Insert(point, scan);
    likelihood_.reset();
  }

  const SurfaceMap& surfaces() const { return surfaces_; }
  const LikelihoodPyramid& likelihood();

 private:
  SurfaceMap surfaces_;
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
