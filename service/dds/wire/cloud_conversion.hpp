// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/entities/wire_types.hpp"
#include "service/team/scans/cloud_scan.hpp"

/// Clouds on the wire. What comes from there is never trusted: a layout that does not fit its own
/// data is refused before a byte of it is read.
namespace qwsm::dds {

/// Says why a sample must not be converted; empty if it may. It needs fields x, y and z, each a
/// number of 32 or 64 bits; others may stand beside them, in any layout.
std::string_view ObjectionTo(const wire::PointCloud2& sample);
/// The cloud of a sample. Points that are not finite are left out, as drivers mark beams without an
/// echo by them.
/// @pre ObjectionTo(sample).empty()
team::CloudScan FromWire(const wire::PointCloud2& sample);

/// The number of bits of a coordinate on the wire; the values are codes of sensor_msgs/PointField.
enum class CloudPrecision : std::uint8_t {
  kSingle = 7,  ///< 32 bits, as viewers expect.
  kDouble = 8,  ///< 64 bits: nothing is rounded.
};

/// Points as a sample (x, y, z), which points into this object.
class CloudSample {
 public:
  /// Makes the sample of a cloud. @param frame outlives this.
  CloudSample(const slam6d::PointCloud& cloud,
              CloudPrecision precision,
              Timestamp stamp,
              const std::string& frame);
  /// Makes the sample of points of the plane, at height 0.
  CloudSample(std::span<const Eigen::Vector2d> points_m, Timestamp stamp, const std::string& frame);
  CloudSample(const CloudSample&) = delete;
  CloudSample& operator=(const CloudSample&) = delete;

  const wire::PointCloud2& sample() const { return sample_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::vector<sensor_msgs_msg_dds__PointField_> fields_;
  wire::PointCloud2 sample_{};
};

}  // namespace qwsm::dds
