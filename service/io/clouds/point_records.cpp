// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/point_records.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "service/io/clouds/text_points.hpp"
#include "service/io/files/byte_source.hpp"
#include "service/io/files/file_error.hpp"

namespace slam6d::io {
namespace {

constexpr std::size_t kMostColumns = 10'000;
constexpr std::size_t kBufferBytes = std::size_t{1} << 18U;

// The formats are little endian, and so are the machines this is built for.
template <class Number>
double Load(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(number));
  return static_cast<double>(number);
}

double LoadNumber(const char* bytes, NumberType type) {
  switch (type) {
    case NumberType::kInt8:
      return Load<std::int8_t>(bytes);
    case NumberType::kUint8:
      return Load<std::uint8_t>(bytes);
    case NumberType::kInt16:
      return Load<std::int16_t>(bytes);
    case NumberType::kUint16:
      return Load<std::uint16_t>(bytes);
    case NumberType::kInt32:
      return Load<std::int32_t>(bytes);
    case NumberType::kUint32:
      return Load<std::uint32_t>(bytes);
    case NumberType::kInt64:
      return Load<std::int64_t>(bytes);
    case NumberType::kUint64:
      return Load<std::uint64_t>(bytes);
    case NumberType::kFloat32:
      return Load<float>(bytes);
    case NumberType::kFloat64:
      return Load<double>(bytes);
  }
  return 0.0;
}

/// The numbers in the columns of x, y and z; nothing where one is missing or not finite.
std::optional<Eigen::Vector3d> PointInLine(std::string_view line, const RecordLayout& layout) {
  Eigen::Vector3d point_m;
  std::size_t found = 0;
  for (std::size_t column = 0; column < layout.columns && found < 3; ++column) {
    const std::optional<double> value = NextNumber(line);
    for (int axis = 0; axis < 3; ++axis) {
      if (layout.xyz[static_cast<std::size_t>(axis)]->column != column) continue;
      if (!value) return std::nullopt;
      point_m(axis) = *value;
      ++found;
    }
    if (!value) {  // Of another column: "nan" stands for no value.
      line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
      line.remove_prefix(std::min(line.find_first_of(" \t"), line.size()));
    }
  }
  if (found < 3) return std::nullopt;
  return point_m;
}

}  // namespace

std::size_t SizeOf(NumberType type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

void RecordLayout::Add(std::string_view name, NumberType type, std::size_t count) {
  constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
  count = std::min(count, kMostColumns + 1);  // Check() refuses it; sums are not to overflow.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (name == kNames[axis] && count > 0)
      xyz[axis] = Field{.offset = bytes, .column = columns, .type = type};
  }
  bytes += count * SizeOf(type);
  columns += count;
}

void RecordLayout::Check(const std::filesystem::path& file) const {
  if (columns > kMostColumns) {
    throw std::runtime_error(file.string() + ": its header gives a point more than 10000 numbers");
  }
  if (xyz[0] && xyz[1] && xyz[2]) return;
  throw std::runtime_error(file.string() + ": its header names no fields x, y and z");
}

RecordFile::RecordFile(const std::filesystem::path& file) : path(file) {
  std::ifstream stream = qwsm::io::OpenForReading(file);
  qwsm::io::ByteSource source(stream);
  std::vector<char> buffer(kBufferBytes);
  try {
    while (const std::size_t count = source.Read(buffer)) bytes.append(buffer.data(), count);
  } catch (const std::runtime_error& error) {
    // A cut archive: what was good is used, and the records that are missing are told of.
    if (bytes.empty()) throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::optional<std::string_view> RecordFile::NextLine() {
  if (at >= bytes.size()) return std::nullopt;
  const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
  std::string_view text = std::string_view(bytes).substr(at, end - at);
  at = std::min(end + 1, bytes.size());
  ++line;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::size_t RecordFile::Count(std::string_view word) const {
  std::size_t count = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, count);
  if (error == std::errc{} && rest == end) return count;
  Fail("'" + std::string(word) + "' in the header is no count");
}

std::string RecordFile::Problem(const std::string& what) const {
  return path.string() + ":" + std::to_string(line) + ": " + what;
}

void RecordFile::Fail(const std::string& what) const { throw std::runtime_error(Problem(what)); }

void TakeBinary(RecordFile& file,
                const RecordLayout& layout,
                std::size_t count,
                ScanPoints& points) {
  const std::size_t there = (file.bytes.size() - file.at) / layout.bytes;
  points.cloud.reserve(std::min(count, there));
  for (std::size_t i = 0; i < std::min(count, there); ++i, file.at += layout.bytes) {
    Eigen::Vector3d point_m;
    for (int axis = 0; axis < 3; ++axis) {
      const RecordLayout::Field& field = *layout.xyz[static_cast<std::size_t>(axis)];
      point_m(axis) = LoadNumber(file.bytes.data() + file.at + field.offset, field.type);
    }
    if (point_m.allFinite()) {
      points.cloud.push_back(point_m);
    } else {
      points.Skip(file.path.string() + ": point " + std::to_string(i) + " is not finite");
    }
  }
  if (there < count) {
    points.Skip(file.path.string() + ": ends after " + std::to_string(there) + " of " +
                std::to_string(count) + " points");
  }
}

void TakeText(RecordFile& file, const RecordLayout& layout, std::size_t count, ScanPoints& points) {
  for (std::size_t taken = 0; taken < count;) {
    const std::optional<std::string_view> line = file.NextLine();
    if (!line) {
      return points.Skip(file.path.string() + ": ends after " + std::to_string(taken) + " of " +
                         std::to_string(count) + " points");
    }
    if (IsBlank(*line)) continue;
    ++taken;
    if (const std::optional<Eigen::Vector3d> point_m = PointInLine(*line, layout)) {
      points.cloud.push_back(*point_m);
    } else {
      points.Skip(file.Problem("expected finite numbers for x, y and z"));
    }
  }
}

ScanPoints ReadKittiPoints(const std::filesystem::path& path) {
  RecordLayout layout;
  for (const char* name : {"x", "y", "z", "intensity"}) layout.Add(name, NumberType::kFloat32);
  RecordFile file(path);
  ScanPoints points;
  const std::size_t count = file.bytes.size() / layout.bytes;
  TakeBinary(file, layout, count, points);
  if (file.bytes.size() % layout.bytes != 0) {
    points.Skip(path.string() + ": its size is no multiple of 16 bytes; the end is left out");
  }
  return points;
}

}  // namespace slam6d::io
