// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/ply_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "service/io/clouds/point_records.hpp"
#include "service/io/files/atomic_file.hpp"

namespace slam6d::io {
namespace {

static_assert(std::endian::native == std::endian::little);

struct PlyHeader {
  bool binary = false;
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
    if (keyword == "end_header") return header;
    if (keyword == "format") {
      std::string format;
      words >> format;
      ReadFormat(file, format, header);
    } else if (keyword == "element") {
      if (element.empty() && words >> element && element != "vertex") {
        file.Fail("the first element must be 'vertex', not '" + element + "'");
      }
      if (header.layout.columns == 0 && !(words >> header.vertices)) {
        file.Fail("expected a number of vertices");
      }
      if (header.layout.columns > 0) element = "other";
    } else if (keyword == "property" && element == "vertex") {
      ReadProperty(file, words, header);
    }
  }
  file.Fail("the header has no end_header");
}

}  // namespace

ScanPoints ReadPly(const std::filesystem::path& path) {
  RecordFile file(path);
  const PlyHeader header = ReadPlyHeader(file);
  header.layout.Check(path);
  ScanPoints points;
  if (header.binary) {
    TakeBinary(file, header.layout, header.vertices, points);
  } else {
    TakeText(file, header.layout, header.vertices, points);
  }
  return points;
}

void WritePly(const std::filesystem::path& path, const PointCloud& cloud) {
  qwsm::io::AtomicFile file(path);
  file.stream() << "ply\nformat binary_little_endian 1.0\ncomment metres, x forward, y left, z up\n"
                << "element vertex " << cloud.size()
                << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f point_m = cloud[i].cast<float>();
    std::array<char, sizeof(float) * 3> bytes{};
    std::memcpy(bytes.data(), point_m.data(), bytes.size());
    file.stream().write(bytes.data(), bytes.size());
  }
  file.Commit();
}

}  // namespace slam6d::io
