// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/ros_encoding.hpp"

#include <array>
#include <chrono>
#include <limits>

#include "service/io/bags/messages/transform3.hpp"
#include "service/io/bags/writing/cdr_writer.hpp"
#include "service/io/files/atomic_file.hpp"

namespace qwsm::io {
namespace {

// Indices of x, y and yaw among (x, y, z, roll, pitch, yaw).
constexpr std::array kPlanarAxes{0, 1, 5};
constexpr int kSpatialAxes = 6;

void AddTime(CdrWriter& fields, Timestamp stamp) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp);
  fields.Add(static_cast<std::int32_t>(seconds.count()));
  fields.Add(static_cast<std::uint32_t>((stamp - seconds).count()));
}

void AddHeader(CdrWriter& fields, Timestamp stamp, std::string_view frame) {
  AddTime(fields, stamp);
  fields.Add(frame);
}

void AddPose(CdrWriter& fields, const Pose2& pose) {
  const Transform3 spatial = Spatial(pose);
  fields.Add(spatial.x_m);
  fields.Add(spatial.y_m);
  fields.Add(spatial.z_m);
  fields.Add(spatial.rotation.x);
  fields.Add(spatial.rotation.y);
  fields.Add(spatial.rotation.z);
  fields.Add(spatial.rotation.w);
}

void AddZeros(CdrWriter& fields, int count) {
  for (int i = 0; i < count; ++i) fields.Add(0.0);
}

void AddVector(CdrWriter& fields, const Eigen::Vector3d& vector) {
  for (const double value : vector) fields.Add(value);
}

/// A covariance of three axes of which it is only known whether there is anything.
void AddUnknownCovariance(CdrWriter& fields, bool is_measured) {
  fields.Add(is_measured ? 0.0 : -1.0);
  AddZeros(fields, 8);
}

int PlanarIndex(int axis) {
  for (int i = 0; i < 3; ++i) {
    if (kPlanarAxes[static_cast<std::size_t>(i)] == axis) return i;
  }
  return -1;
}

std::uint8_t OccupancyOf(CellState state) {
  constexpr std::uint8_t kMinusOne = 0xFF;
  if (state == CellState::kUnknown) return kMinusOne;
  return state == CellState::kOccupied ? 100 : 0;
}

}  // namespace

void CheckRosTime(Timestamp stamp) {
  constexpr auto kLast = std::chrono::seconds(std::numeric_limits<std::int32_t>::max());
  if (stamp >= Timestamp::zero() && stamp <= kLast) return;
  throw WriteError("a record has the stamp " + std::to_string(stamp.count() / 1'000'000'000) +
                   " s: messages of ROS 2 have 0 to 2147483647 s");
}

std::string EncodeLaserScan(const LaserScan& scan, std::string_view frame) {
  const LaserGeometry& geometry = scan.geometry;
  CdrWriter fields;
  AddHeader(fields, scan.stamp, frame);
  fields.Add(geometry.first_bearing_rad);
  fields.Add(static_cast<float>(scan.size() > 0 ? geometry.Bearing(scan.size() - 1) : 0.0));
  fields.Add(geometry.bearing_step_rad);
  const double gaps = scan.size() > 1 ? static_cast<double>(scan.size() - 1) : 1.0;
  fields.Add(static_cast<float>(Seconds(scan.sweep) / gaps));
  fields.Add(0.0F);  // Time between scans.
  fields.Add(geometry.range_min_m);
  fields.Add(geometry.range_max_m);
  fields.Add(static_cast<std::uint32_t>(scan.size()));
  for (const float range_m : scan.ranges_m) fields.Add(range_m);
  fields.Add(std::uint32_t{0});  // Intensities.
  return fields.bytes();
}

std::string EncodeImu(const ImuReading& reading, std::string_view frame) {
  CdrWriter fields;
  AddHeader(fields, reading.stamp, frame);
  const Quaternion q = reading.orientation.value_or(Quaternion{});
  AddVector(fields, {q.x, q.y, q.z});
  fields.Add(q.w);
  AddUnknownCovariance(fields, reading.orientation.has_value());
  AddVector(fields, reading.turn_rate_rad_s);
  AddUnknownCovariance(fields, true);
  AddVector(fields, reading.acceleration_mps2.value_or(Eigen::Vector3d::Zero()));
  AddUnknownCovariance(fields, reading.acceleration_mps2.has_value());
  return fields.bytes();
}

std::string EncodeOdometry(Timestamp stamp,
                           std::string_view frame,
                           std::string_view child,
                           const Pose2& pose) {
  CdrWriter fields;
  AddHeader(fields, stamp, frame);
  fields.Add(child);
  AddPose(fields, pose);
  AddZeros(fields, kSpatialAxes * kSpatialAxes);
  AddZeros(fields, kSpatialAxes + kSpatialAxes * kSpatialAxes);
  return fields.bytes();
}

std::string EncodeTransform(Timestamp stamp,
                            std::string_view frame,
                            std::string_view child,
                            const Pose2& pose) {
  CdrWriter fields;
  fields.Add(std::uint32_t{1});
  AddHeader(fields, stamp, frame);
  fields.Add(child);
  AddPose(fields, pose);
  return fields.bytes();
}

std::string EncodePose(Timestamp stamp, std::string_view frame, const UncertainPose2& pose) {
  CdrWriter fields;
  AddHeader(fields, stamp, frame);
  AddPose(fields, pose.T_a_b);
  for (int row = 0; row < kSpatialAxes; ++row) {
    for (int column = 0; column < kSpatialAxes; ++column) {
      const int i = PlanarIndex(row);
      const int j = PlanarIndex(column);
      fields.Add(i < 0 || j < 0 ? 0.0 : pose.covariance(i, j));
    }
  }
  return fields.bytes();
}

std::string EncodeGrid(Timestamp stamp, std::string_view frame, const OccupancyGrid& grid) {
  CdrWriter fields;
  AddHeader(fields, stamp, frame);
  AddTime(fields, stamp);
  fields.Add(static_cast<float>(grid.cell_m));
  fields.Add(static_cast<std::uint32_t>(grid.width));
  fields.Add(static_cast<std::uint32_t>(grid.height));
  AddPose(fields, {grid.origin_map_m.x(), grid.origin_map_m.y(), 0.0});
  fields.Add(static_cast<std::uint32_t>(grid.cells.size()));
  for (const CellState cell : grid.cells) fields.Add(OccupancyOf(cell));
  return fields.bytes();
}

}  // namespace qwsm::io
