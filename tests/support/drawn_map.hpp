// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "service/dds/entities/wire_types.hpp"

namespace qwsm::test {

/// A map as a service publishes it: walls every so many cells, in both directions.
class DrawnMap {
 public:
  DrawnMap(std::uint32_t side, std::uint32_t between_walls) : cells_(std::size_t{side} * side) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      cells_[i] = i % side % between_walls == 0 || i / side % between_walls == 0 ? 100 : 0;
    }
    sample_.header.frame_id = frame_.data();
    sample_.info = {
        .map_load_time = {}, .resolution = 0.05F, .width = side, .height = side, .origin = {}};
    const auto size = static_cast<std::uint32_t>(cells_.size());
    sample_.data = {._maximum = size, ._length = size, ._buffer = cells_.data(), ._release = false};
  }
  DrawnMap(const DrawnMap&) = delete;
  DrawnMap& operator=(const DrawnMap&) = delete;

  const dds::wire::OccupancyGrid& sample() const { return sample_; }

 private:
  std::string frame_ = "map";
  std::vector<std::int8_t> cells_;
  dds::wire::OccupancyGrid sample_{};
};

}  // namespace qwsm::test
