// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/map_conversion.hpp"

#include <algorithm>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {
namespace {

std::int8_t OccupancyOf(CellState state) {
  switch (state) {
    case CellState::kFree:
      return 0;
    case CellState::kOccupied:
      return 100;
    case CellState::kUnknown:
      break;
  }
  return -1;
}

}  // namespace

MapSample::MapSample(const OccupancyGrid& grid, Timestamp stamp, const std::string& frame)
    : cells_(grid.cells.size()) {
  std::ranges::transform(grid.cells, cells_.begin(), OccupancyOf);
  sample_.header = HeaderOf(stamp, frame);
  sample_.info.map_load_time = ToWire(stamp);
  sample_.info.resolution = static_cast<float>(grid.cell_m);
  sample_.info.width = static_cast<std::uint32_t>(grid.width);
  sample_.info.height = static_cast<std::uint32_t>(grid.height);
  sample_.info.origin = ToWire(Pose2{grid.origin_map_m.x(), grid.origin_map_m.y(), 0.0});
  const auto size = static_cast<std::uint32_t>(cells_.size());
  sample_.data = {._maximum = size, ._length = size, ._buffer = cells_.data(), ._release = false};
}

}  // namespace qwsm::dds
