// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/ply_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "service/io/clouds/point_records.hpp"
#include "service/io/files/atomic_file.hpp"

namespace slam6d::io {
namespace {

static_assert(std::endian::native == std::endian::little);

struct PlyHeader {
  std::optional<bool> binary;
  std::size_t vertices = 0;
  RecordLayout layout;
};

std::optional<NumberType> TypeNamed(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, NumberType>, 16> kTypes{{
      {"char", NumberType::kInt8},
      {"int8", NumberType::kInt8},
      {"uchar", NumberType::kUint8},
      {"uint8", NumberType::kUint8},
      {"short", NumberType::kInt16},
      {"int16", NumberType::kInt16},
      {"ushort", NumberType::kUint16},
      {"uint16", NumberType::kUint16},
      {"int", NumberType::kInt32},
      {"int32", NumberType::kInt32},
      {"uint", NumberType::kUint32},
      {"uint32", NumberType::kUint32},
      {"float", NumberType::kFloat32},
      {"float32", NumberType::kFloat32},
      {"double", NumberType::kFloat64},
      {"float64", NumberType::kFloat64},
  }};
  const auto* found =
      std::ranges::find(kTypes, name, &std::pair<std::string_view, NumberType>::first);
  if (found == kTypes.end()) return std::nullopt;
  return found->second;
}

void ReadFormat(const RecordFile& file, const std::string& format, PlyHeader& header) {
  if (format != "ascii" && format != "binary_little_endian") {
    file.Fail("the format '" + format + "' is not read; ascii and binary_little_endian are");
  }
  header.binary = format != "ascii";
}

void ReadProperty(const RecordFile& file, std::istringstream& words, PlyHeader& header) {
  std::string type;
  std::string name;
  words >> type >> name;
  const std::optional<NumberType> number = TypeNamed(type);
  if (!number) file.Fail("a vertex may not have a property of type '" + type + "'");
  header.layout.Add(name, *number);
}

PlyHeader ReadPlyHeader(RecordFile& file) {
  if (file.NextLine() != "ply") file.Fail("a PLY file begins with the line 'ply'");
  PlyHeader header;
  std::string element;
  while (const std::optional<std::string_view> line = file.NextLine()) {
    std::istringstream words{std::string(*line)};
    std::string keyword;
    words >> keyword;
    if (keyword == "end_header") {
      if (!header.binary) file.Fail("the header has no line 'format'");
      return header;
    }
    if (keyword == "format") {
      std::string format;
      words >> format;
      ReadFormat(file, format, header);
    } else if (keyword == "element") {
      if (element.empty() && words >> element && element != "vertex") {
        file.Fail("the first element must be 'vertex', not '" + element + "'");
      }
      std::string count;
      words >> count;
      if (header.layout.columns == 0) header.vertices = file.Count(count);
      if (header.layout.columns > 0) element = "other";
    } else if (keyword == "property" && element == "vertex") {
      ReadProperty(file, words, header);
    }
  }
  file.Fail("the header has no end_header");
}

/// A step between two floats is no larger than this where they will do.
constexpr double kLargestFloatStep_m = 1e-3;

/// Whether floats are as good as doubles: they are not where a model lies far from its origin.
bool FitsFloats(const PointCloud& cloud) {
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    farthest_m = std::max(farthest_m, cloud[i].cwiseAbs().maxCoeff());
  }
  constexpr auto kStepShare = static_cast<double>(std::numeric_limits<float>::epsilon());
  return kStepShare * farthest_m <= kLargestFloatStep_m;
}

template <class Number>
void WriteVertices(std::ostream& stream, const PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Matrix<Number, 3, 1> point_m = cloud[i].cast<Number>();
    std::array<char, sizeof(Number) * 3> bytes{};
    std::memcpy(bytes.data(), point_m.data(), bytes.size());
    stream.write(bytes.data(), bytes.size());
  }
}

}  // namespace

ScanPoints ReadPly(const std::filesystem::path& path) {
  RecordFile file(path);
  const PlyHeader header = ReadPlyHeader(file);
  header.layout.Check(path);
  ScanPoints points;
  if (*header.binary) {
    TakeBinary(file, header.layout, header.vertices, points);
  } else {
    TakeText(file, header.layout, header.vertices, points);
  }
  return points;
}

void WritePly(const std::filesystem::path& path, const PointCloud& cloud) {
  qwsm::io::AtomicFile file(path);
  const bool as_floats = FitsFloats(cloud);
  file.stream() << "ply\nformat binary_little_endian 1.0\ncomment metres, x forward, y left, z up\n"
                << "element vertex " << cloud.size() << "\n";
  for (const char axis : {'x', 'y', 'z'}) {
    file.stream() << "property " << (as_floats ? "float " : "double ") << axis << "\n";
  }
  file.stream() << "end_header\n";
  if (as_floats) {
    WriteVertices<float>(file.stream(), cloud);
  } else {
    WriteVertices<double>(file.stream(), cloud);
  }
  file.Commit();
}

}  // namespace slam6d::io
