// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace qwsm::io {

/// What a point of interest is drawn as.
enum class InterestKind : std::uint8_t { kVictim, kHazard, kObject };

/// Something that somebody marked in the map, as the RoboCup Rescue League lists it.
struct PointOfInterest {
  std::string id;    ///< Number that is drawn on the mark.
  std::string time;  ///< When it was found, as it was given: "10:21:34".
  std::string text;
  Eigen::Vector3d p_map_m = Eigen::Vector3d::Zero();
  std::string robot = "1";
  std::string mode = "T";  ///< "A" where the robot found it by itself, "T" where it was driven.
  std::string type;        ///< "victim", "hazmat", "qr", ...
};

/// The kind of a type: victims and hazards under the names that teams use for them, whatever their
/// case; all else is an object.
InterestKind KindOf(std::string_view type);

/// Reads a list of points of interest: a table with commas whose first line names its columns, of
/// which x, y and type are needed, in any order; metres in the frame `map`. What stands before the
/// line with the names, as in files of the league, is passed over. Without the column id the points
/// are numbered from 1.
/// @throws std::runtime_error "name:line: what is wrong".
std::vector<PointOfInterest> ReadPointsOfInterest(std::istream& stream, std::string_view name);
std::vector<PointOfInterest> ReadPointsOfInterest(const std::filesystem::path& path);

/// What a list begins with: who made it, where and when.
struct MissionTitle {
  std::string team;
  std::string country;
  std::string date;  ///< Day of the start: "2026-07-04".
  std::string time;  ///< Time of the start: "10:15:00".
  std::string mission;
};

/// Writes the list as the league wants it, version 1.2. @throws WriteError.
void WritePointsOfInterest(const std::filesystem::path& path,
                           const MissionTitle& title,
                           std::span<const PointOfInterest> points);

}  // namespace qwsm::io
