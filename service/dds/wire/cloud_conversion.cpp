// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/cloud_conversion.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

/// Where in a point's bytes a coordinate stands.
struct Coordinate {
  std::uint32_t offset = 0;
  CloudPrecision precision = CloudPrecision::kSingle;
};

std::uint32_t BytesOf(CloudPrecision precision) {
  return precision == CloudPrecision::kSingle ? sizeof(float) : sizeof(double);
}

std::optional<sensor_msgs_msg_dds__PointField_> FieldNamed(const wire::PointCloud2& sample,
                                                           const char* name) {
  for (std::uint32_t i = 0; i < sample.fields._length; ++i) {
    const auto& field = sample.fields._buffer[i];
    if (std::strcmp(field.name, name) == 0) return field;
  }
  return std::nullopt;
}

std::string_view ObjectionToFields(const wire::PointCloud2& sample) {
  for (const char* const axis : kAxes) {
    const auto field = FieldNamed(sample, axis);
    if (!field) return "it has no fields x, y and z";
    const auto precision = static_cast<CloudPrecision>(field->datatype);
    if (precision != CloudPrecision::kSingle && precision != CloudPrecision::kDouble) {
      return "its fields x, y and z are not FLOAT32 or FLOAT64";
    }
    if (field->count > 1) return "its fields x, y and z have more than one element";
    if (std::uint64_t{field->offset} + BytesOf(precision) > sample.point_step) {
      return "its fields x, y and z reach beyond point_step";
    }
  }
  return {};
}

std::string_view ObjectionToSize(const wire::PointCloud2& sample) {
  const std::uint64_t points = std::uint64_t{sample.width} * sample.height;
  if (points == 0) return "it has no points";
  if (points > team::kMaxCloudPoints) return "it has more than 20 million points";
  if (std::uint64_t{sample.width} * sample.point_step > sample.row_step) {
    return "its row_step is less than width times point_step";
  }
  if (std::uint64_t{sample.row_step} * sample.height != sample.data._length) {
    return "its data are not as long as row_step times height";
  }
  return {};
}

std::array<Coordinate, 3> CoordinatesOf(const wire::PointCloud2& sample) {
  std::array<Coordinate, 3> coordinates;
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const auto field = FieldNamed(sample, kAxes[axis]);
    coordinates[axis] = {field->offset, static_cast<CloudPrecision>(field->datatype)};
  }
  return coordinates;
}

double Read(const std::uint8_t* point, const Coordinate& coordinate) {
  if (coordinate.precision == CloudPrecision::kDouble) {
    double value = 0.0;
    std::memcpy(&value, point + coordinate.offset, sizeof value);
    return value;
  }
  float value = 0.0F;
  std::memcpy(&value, point + coordinate.offset, sizeof value);
  return value;
}

void Append(double value, CloudPrecision precision, std::vector<std::uint8_t>& bytes) {
  const auto single = static_cast<float>(value);
  const void* const from =
      precision == CloudPrecision::kSingle ? static_cast<const void*>(&single) : &value;
  const std::size_t at = bytes.size();
  bytes.resize(at + BytesOf(precision));
  std::memcpy(bytes.data() + at, from, BytesOf(precision));
}

slam6d::PointCloud InSpace(std::span<const Eigen::Vector2d> points_m) {
  slam6d::PointCloud cloud;
  cloud.reserve(points_m.size());
  for (const Eigen::Vector2d& p : points_m) cloud.push_back({p.x(), p.y(), 0.0});
  return cloud;
}

}  // namespace

std::string_view ObjectionTo(const wire::PointCloud2& sample) {
  std::string_view objection = ObjectionTo(sample.header);
  if (objection.empty() && sample.is_bigendian) objection = "its numbers are big-endian";
  if (objection.empty()) objection = ObjectionToSize(sample);
  if (objection.empty()) objection = ObjectionToFields(sample);
  return objection;
}

team::CloudScan FromWire(const wire::PointCloud2& sample) {
  const auto [x, y, z] = CoordinatesOf(sample);
  team::CloudScan scan{.stamp = *FromWire(sample.header.stamp), .cloud = {}, .T_robot_sensor = {}};
  scan.cloud.reserve(std::size_t{sample.width} * sample.height);
  for (std::uint32_t row = 0; row < sample.height; ++row) {
    const std::uint8_t* point = sample.data._buffer + std::size_t{row} * sample.row_step;
    for (std::uint32_t column = 0; column < sample.width; ++column, point += sample.point_step) {
      const Eigen::Vector3d point_m(Read(point, x), Read(point, y), Read(point, z));
      if (point_m.allFinite()) scan.cloud.push_back(point_m);
    }
  }
  return scan;
}

CloudSample::CloudSample(const slam6d::PointCloud& cloud,
                         CloudPrecision precision,
                         Timestamp stamp,
                         const std::string& frame) {
  bytes_.reserve(cloud.size() * kAxes.size() * BytesOf(precision));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const double value : cloud[i]) Append(value, precision, bytes_);
  }
  for (const char* const axis : kAxes) {
    fields_.push_back({.name = const_cast<char*>(axis),
                       .offset = static_cast<std::uint32_t>(fields_.size()) * BytesOf(precision),
                       .datatype = static_cast<std::uint8_t>(precision),
                       .count = 1});
  }
  const auto size = static_cast<std::uint32_t>(bytes_.size());
  sample_.header = HeaderOf(stamp, frame);
  sample_.height = 1;
  sample_.width = static_cast<std::uint32_t>(cloud.size());
  sample_.fields = {._maximum = 3, ._length = 3, ._buffer = fields_.data(), ._release = false};
  sample_.point_step = static_cast<std::uint32_t>(kAxes.size()) * BytesOf(precision);
  sample_.row_step = size;
  sample_.data = {._maximum = size, ._length = size, ._buffer = bytes_.data(), ._release = false};
  sample_.is_dense = true;
}

CloudSample::CloudSample(std::span<const Eigen::Vector2d> points_m,
                         Timestamp stamp,
                         const std::string& frame)
    : CloudSample(InSpace(points_m), CloudPrecision::kSingle, stamp, frame) {}

}  // namespace qwsm::dds
