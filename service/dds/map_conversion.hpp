// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/dds/wire_types.hpp"

namespace qwsm::dds {

/// An occupancy map as a sample, which points into this object.
class MapSample {
 public:
  /// @param frame outlives this.
  MapSample(const OccupancyGrid& grid, Timestamp stamp, const std::string& frame);
  MapSample(const MapSample&) = delete;
  MapSample& operator=(const MapSample&) = delete;

  const wire::OccupancyGrid& sample() const { return sample_; }

 private:
  std::vector<std::int8_t> cells_;  // -1 unknown, 0 free, 100 occupied.
  wire::OccupancyGrid sample_{};
};

/// Points as a cloud of (x, y, z), which points into this object.
class CloudSample {
 public:
  /// @param frame outlives this.
  CloudSample(std::span<const Eigen::Vector2d> points_m, Timestamp stamp, const std::string& frame);
  CloudSample(const CloudSample&) = delete;
  CloudSample& operator=(const CloudSample&) = delete;

  const wire::PointCloud2& sample() const { return sample_; }

 private:
  std::vector<float> xyz_m_;
  std::vector<sensor_msgs_msg_dds__PointField_> fields_;
  wire::PointCloud2 sample_{};
};

}  // namespace qwsm::dds
