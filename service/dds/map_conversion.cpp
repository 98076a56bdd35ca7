// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/map_conversion.hpp"

#include <algorithm>
#include <bit>

#include "service/dds/planar.hpp"

namespace qwsm::dds {
namespace {

constexpr std::uint8_t kFloat32 = 7;  // sensor_msgs/PointField

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

CloudSample::CloudSample(std::span<const Eigen::Vector2d> points_m,
                         Timestamp stamp,
                         const std::string& frame) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint32_t kPointBytes = 3 * sizeof(float);
  for (const Eigen::Vector2d& p : points_m) {
    xyz_m_.insert(xyz_m_.end(), {static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F});
  }
  static char names[3][2] = {"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    fields_.push_back({.name = names[i],
                       .offset = i * static_cast<std::uint32_t>(sizeof(float)),
                       .datatype = kFloat32,
                       .count = 1});
  }
  sample_.header = HeaderOf(stamp, frame);
  sample_.height = 1;
  sample_.width = static_cast<std::uint32_t>(points_m.size());
  sample_.fields = {._maximum = 3, ._length = 3, ._buffer = fields_.data(), ._release = false};
  sample_.point_step = kPointBytes;
  sample_.row_step = kPointBytes * sample_.width;
  sample_.data = {._maximum = sample_.row_step,
                  ._length = sample_.row_step,
                  ._buffer = reinterpret_cast<std::uint8_t*>(xyz_m_.data()),
                  ._release = false};
  sample_.is_dense = true;
}

}  // namespace qwsm::dds
