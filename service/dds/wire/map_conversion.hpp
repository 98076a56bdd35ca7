// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/dds/entities/wire_types.hpp"

namespace qwsm::dds {

/// An occupancy map as a sample, which points into this object.
class MapSample {
 public:
  /// Makes the sample of a grid. @param frame outlives this.
  MapSample(const OccupancyGrid& grid, Timestamp stamp, const std::string& frame);
  MapSample(const MapSample&) = delete;
  MapSample& operator=(const MapSample&) = delete;

  const wire::OccupancyGrid& sample() const { return sample_; }

 private:
  std::vector<std::int8_t> cells_;  // Per cell: -1 unknown, 0 free, 100 occupied.
  wire::OccupancyGrid sample_{};
};

}  // namespace qwsm::dds
