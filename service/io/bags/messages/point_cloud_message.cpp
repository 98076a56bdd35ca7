// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/messages/point_cloud_message.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "service/io/bags/messages/message_reader.hpp"

namespace qwsm::io {
namespace {

constexpr std::uint64_t kMostPoints = 20'000'000;
// A field is never shorter than the length of its name, its offset, its type and its count.
constexpr std::size_t kLeastFieldBytes = 13;
constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

// Codes of sensor_msgs/PointField.
enum NumberCode : std::uint8_t { kFloat32 = 7, kFloat64 = 8 };

/// Where in the bytes of a point a coordinate stands.
struct CoordinateField {
  std::uint32_t offset = 0;
  std::uint8_t type = 0;

  std::uint64_t end() const {
    return std::uint64_t{offset} + (type == kFloat64 ? sizeof(double) : sizeof(float));
  }
};

/// How the points stand in the data.
struct CloudLayout {
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::array<std::optional<CoordinateField>, 3> xyz;
  bool is_big_endian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
};

void TakeFields(MessageReader& message, CloudLayout& layout) {
  const std::size_t count = message.Count(kLeastFieldBytes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = message.String();
    CoordinateField field{.offset = message.Unsigned32()};
    field.type = message.Byte();
    message.Unsigned32();  // How many numbers there are: others of an axis are not looked at.
    const auto* const axis = std::ranges::find(kAxes, name);
    if (axis != kAxes.end()) layout.xyz[static_cast<std::size_t>(axis - kAxes.begin())] = field;
  }
}

void Check(const CloudLayout& layout, std::size_t data_size) {
  const std::uint64_t points = std::uint64_t{layout.width} * layout.height;
  if (points > kMostPoints) throw MessageError("it has more than 20 million points");
  for (const std::optional<CoordinateField>& field : layout.xyz) {
    if (!field) throw MessageError("it has no fields x, y and z");
    if (field->type != kFloat32 && field->type != kFloat64) {
      throw MessageError("its fields x, y and z are not FLOAT32 or FLOAT64");
    }
    if (field->end() > layout.point_step) {
      throw MessageError("its fields x, y and z reach beyond its point_step");
    }
  }
  if (std::uint64_t{layout.width} * layout.point_step > layout.row_step ||
      std::uint64_t{layout.row_step} * layout.height > data_size) {
    throw MessageError("its data are shorter than its width, height and steps say");
  }
}

template <class Number>
double Load(const char* from, bool is_big_endian) {
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), from, sizeof(Number));
  if (is_big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
  return static_cast<double>(std::bit_cast<Number>(raw));
}

std::array<double, 3> PointAt(const char* from, const CloudLayout& layout) {
  std::array<double, 3> point_m{};
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const CoordinateField& field = *layout.xyz[axis];
    const char* const number = from + field.offset;
    point_m[axis] = field.type == kFloat64 ? Load<double>(number, layout.is_big_endian)
                                           : Load<float>(number, layout.is_big_endian);
  }
  return point_m;
}

}  // namespace

PointCloudMessage DecodePointCloud(std::string_view bytes, Encoding encoding) {
  MessageReader message(bytes, encoding);
  PointCloudMessage cloud{.header = TakeHeader(message), .points_m = {}};
  CloudLayout layout;
  layout.height = message.Unsigned32();
  layout.width = message.Unsigned32();
  TakeFields(message, layout);
  layout.is_big_endian = message.Byte() != 0;
  layout.point_step = message.Unsigned32();
  layout.row_step = message.Unsigned32();
  const std::string_view data = message.Bytes(message.Count(1));
  Check(layout, data.size());
  if (layout.width == 0) return cloud;  // Of rows without points there may be billions.
  cloud.points_m.reserve(std::size_t{layout.width} * layout.height);
  for (std::uint32_t row = 0; row < layout.height; ++row) {
    const char* point = data.data() + std::size_t{row} * layout.row_step;
    for (std::uint32_t column = 0; column < layout.width; ++column, point += layout.point_step) {
      const std::array<double, 3> point_m = PointAt(point, layout);
      if (std::ranges::all_of(point_m, [](double value) { return std::isfinite(value); })) {
        cloud.points_m.push_back(point_m);
      }
    }
  }
  return cloud;
}

}  // namespace qwsm::io
