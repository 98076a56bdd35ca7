// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"

namespace qwsm::io {

/// What the file of a saved map begins with.
inline constexpr std::string_view kMapMagic = "QWSM map";

/// Tells of a file that holds no map that can be used. The text names the file and says why:
/// foreign, newer, truncated or damaged.
class MapFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Saves a map with all that mapping needs to go on in it as if it had never stopped: options,
/// relevant scans, and the points of the quadtree.
///
/// Layout, all numbers little endian: "QWSM map", version (u32), CRC-32 of the rest (u32), bytes of
/// the rest (u64), and the rest: marks, in version 2 only; options, scans, points; see
/// map_file.cpp. Version 2 is written where there are marks, so that other maps are read by older
/// releases.
/// @param marks on the map, each as bytes that whoever reads it knows.
/// @throws WriteError where it cannot be written; a file of that name stays as it was then.
void SaveMap(const std::filesystem::path& path,
             const ScanMap& map,
             std::span<const std::string> marks = {});

/// Whether a file begins as that of a saved map does.
bool IsMap(const std::filesystem::path& path);

/// Rebuilds the map scan by scan, as it was built first, and checks that the points are the saved
/// ones. O(points log points). @throws MapFileError
ScanMap LoadMap(const std::filesystem::path& path);

/// Reads the marks on a saved map, without the map. @throws MapFileError
std::vector<std::string> LoadMarksOfMap(const std::filesystem::path& path);

/// The bytes that SaveMap() writes.
std::string EncodeMap(const ScanMap& map, std::span<const std::string> marks = {});
/// Rebuilds the map from the bytes of EncodeMap(); `name` stands for the file in messages.
/// @throws MapFileError
ScanMap DecodeMap(std::string_view bytes, std::string_view name);
/// The marks among those bytes. @throws MapFileError
std::vector<std::string> DecodeMarksOfMap(std::string_view bytes, std::string_view name);

}  // namespace qwsm::io
