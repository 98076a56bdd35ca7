// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/maps/map_file.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/binary.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/maps/option_codec.hpp"

namespace qwsm::io {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kVersionWithMarks = 2;
constexpr std::size_t kHeaderBytes =
    kMapMagic.size() + 2 * sizeof(std::uint32_t) + sizeof(std::uint64_t);
// Of the smallest scan and of a point, which bound what a file of some size can claim to hold.
constexpr std::size_t kScanBytes = 38 * sizeof(std::uint32_t);
constexpr std::size_t kPointBytes = 2 * sizeof(double) + 2 * sizeof(std::uint32_t);
constexpr std::size_t kMarkBytes = sizeof(std::uint64_t);

/// What is behind the header of a file.
struct Contents {
  std::uint32_t version = kVersion;
  std::string_view rest;
};

void AddPoints(BinaryWriter& writer, const PointQuadtree& points) {
  const std::vector<Eigen::Vector2d> positions_m = points.Positions();
  writer.Add(static_cast<std::uint64_t>(points.size()));
  for (PointId id = 0; id < points.id_end(); ++id) {
    if (!points.Contains(id)) continue;
    writer.Add(positions_m[id].x());
    writer.Add(positions_m[id].y());
    writer.Add(static_cast<std::uint32_t>(points.Scan(id)));
    writer.Add(points.Count(id));
  }
}

/// Whether the quadtree holds just the points that follow, in this order.
bool HoldsPoints(BinaryReader& reader, const PointQuadtree& points) {
  if (reader.Count(kPointBytes) != points.size()) return false;
  const std::vector<Eigen::Vector2d> positions_m = points.Positions();
  for (PointId id = 0; id < points.id_end(); ++id) {
    if (!points.Contains(id)) continue;
    const Eigen::Vector2d& p_map_m = positions_m[id];
    const bool same_place = reader.Double() == p_map_m.x() && reader.Double() == p_map_m.y();
    const bool same_origin = same_place && reader.Unsigned32() == points.Scan(id) &&
                             reader.Unsigned32() == points.Count(id);
    if (!same_origin) return false;
  }
  return true;
}

ScanMapOptions ReadMapOptions(BinaryReader& reader) {
  OptionValues values = ReadOptions(reader);
  ScanMapOptions options;
  OptionRestorer restorer(values);
  Describe(restorer, options);
  if (!values.empty()) throw BinaryError("the option " + values.begin()->first + " is unknown");
  return options;
}

std::vector<std::string> ReadMarks(BinaryReader& reader) {
  std::vector<std::string> marks(reader.Count(kMarkBytes));
  for (std::string& mark : marks) mark = reader.Text();
  return marks;
}

ScanMap DecodeContents(const Contents& contents) {
  BinaryReader reader(contents.rest);
  if (contents.version == kVersionWithMarks) ReadMarks(reader);
  ScanMap map(ReadMapOptions(reader));
  const std::size_t scans = reader.Count(kScanBytes);
  for (std::size_t i = 0; i < scans; ++i) {
    RelevantScan relevant = ReadScan(reader);
    map.Insert(std::move(relevant.scan), relevant.map_robot);
  }
  if (!HoldsPoints(reader, map.surfaces().quadtree())) {
    throw BinaryError("its points are not those of its scans; was it saved by another release?");
  }
  if (reader.remaining() > 0) throw BinaryError("there is more in it than a map");
  return map;
}

/// Checks all that can be known before the contents are looked at, and returns them.
Contents CheckHeader(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with(kMapMagic)) throw MapFileError(fmt::format("{}: is no map of qwsm", name));
  if (bytes.size() < kHeaderBytes) throw MapFileError(fmt::format("{}: is truncated", name));
  BinaryReader header(bytes.substr(kMapMagic.size()));
  const std::uint32_t version = header.Unsigned32();
  if (version != kVersion && version != kVersionWithMarks) {
    throw MapFileError(
        fmt::format("{}: is a map of version {}; this release of qwsm reads versions {} and {}",
                    name,
                    version,
                    kVersion,
                    kVersionWithMarks));
  }
  const std::uint32_t checksum = header.Unsigned32();
  const std::uint64_t size = header.Unsigned64();
  const std::string_view rest = bytes.substr(kHeaderBytes);
  if (rest.size() < size) {
    throw MapFileError(fmt::format("{}: is truncated: only {} of {} bytes are there",
                                   name,
                                   bytes.size(),
                                   size + kHeaderBytes));
  }
  if (rest.size() > size) {
    throw MapFileError(fmt::format("{}: is damaged: {} bytes too many", name, rest.size() - size));
  }
  if (Checksum(rest) != checksum) {
    throw MapFileError(fmt::format("{}: is damaged: its checksum is wrong", name));
  }
  return {.version = version, .rest = rest};
}

/// Whatever `decode` makes of the contents of a map.
template <class Decode>
auto Decoded(std::string_view bytes, std::string_view name, const Decode& decode) {
  const Contents contents = CheckHeader(bytes, name);
  try {
    return decode(contents);
  } catch (const BinaryError& error) {
    throw MapFileError(fmt::format("{}: is damaged: {}", name, error.what()));
  }
}

/// All bytes of a map file; of any other, not more than it takes to tell.
std::string ReadBytes(const std::filesystem::path& path) {
  std::ifstream file = OpenForReading(path);
  std::string bytes(kMapMagic.size(), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes == kMapMagic) bytes.append(std::istreambuf_iterator<char>(file), {});
  return bytes;
}

}  // namespace

std::string EncodeMap(const ScanMap& map, std::span<const std::string> marks) {
  BinaryWriter rest;
  if (!marks.empty()) {
    rest.Add(static_cast<std::uint64_t>(marks.size()));
    for (const std::string& mark : marks) rest.Add(std::string_view(mark));
  }
  OptionCollector options;
  ScanMapOptions copy = map.options();
  Describe(options, copy);
  AddOptions(rest, options.values);
  rest.Add(static_cast<std::uint64_t>(map.scans().size()));
  for (const RelevantScan& relevant : map.scans()) AddScan(rest, relevant);
  AddPoints(rest, map.surfaces().quadtree());

  BinaryWriter header;
  header.Add(marks.empty() ? kVersion : kVersionWithMarks);
  header.Add(Checksum(rest.bytes()));
  header.Add(static_cast<std::uint64_t>(rest.bytes().size()));
  return std::string(kMapMagic) + header.bytes() + rest.bytes();
}

ScanMap DecodeMap(std::string_view bytes, std::string_view name) {
  return Decoded(bytes, name, DecodeContents);
}

std::vector<std::string> DecodeMarksOfMap(std::string_view bytes, std::string_view name) {
  return Decoded(bytes, name, [](const Contents& contents) {
    BinaryReader reader(contents.rest);
    return contents.version == kVersionWithMarks ? ReadMarks(reader) : std::vector<std::string>();
  });
}

void SaveMap(const std::filesystem::path& path,
             const ScanMap& map,
             std::span<const std::string> marks) {
  WriteTextFile(path, EncodeMap(map, marks));
}

bool IsMap(const std::filesystem::path& path) {
  std::string first_bytes(kMapMagic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(first_bytes.data(), static_cast<std::streamsize>(first_bytes.size()));
  return file && first_bytes == kMapMagic;
}

ScanMap LoadMap(const std::filesystem::path& path) {
  return DecodeMap(ReadBytes(path), path.string());
}

std::vector<std::string> LoadMarksOfMap(const std::filesystem::path& path) {
  return DecodeMarksOfMap(ReadBytes(path), path.string());
}

}  // namespace qwsm::io
