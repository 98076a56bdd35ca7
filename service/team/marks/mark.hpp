// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {

/// What a mark stands on: a scan that was taken near by. Where the scan goes when the map is
/// corrected, the mark goes along.
struct MarkAnchor {
  std::string robot;  ///< Robot that took the scan, by its namespace.
  Timestamp stamp{};  ///< Stamp of the scan.
  /// Where the mark is in the frame of the robot as it was then.
  Eigen::Vector2d p_robot_m = Eigen::Vector2d::Zero();
};

/// Something that an operator marked on the map: a victim, a hazard, or something else.
struct Mark {
  Timestamp stamp{};           ///< When it was marked or changed: of one id, the newest counts.
  std::uint64_t revision = 0;  ///< How often services have moved or numbered it since.
  std::string id{};            ///< Chosen by whoever made it, never used again.
  std::uint32_t number = 0;    ///< By which people call it; 0: it has none yet.
  std::string kind{};          ///< victim, hazard or note.
  std::string text{};          ///< A name or remark.
  std::string author{};
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  bool is_removed = false;
  std::optional<MarkAnchor> anchor{};  ///< Nothing where there was no map yet.
};

/// Says why a mark must not be taken; empty if it may.
std::string_view ObjectionTo(const Mark& mark);

/// Whether a mark takes the place of one of the same id. All who hear both decide alike.
bool Supersedes(const Mark& mark, const Mark& known);

/// A number for a mark behind those that were given before.
std::uint32_t NumberAfter(const std::set<std::uint32_t>& given);

/// Gives a number of its own to each mark that is there still and has none, or one that a mark of
/// before has, too: services that do not hear each other count alike. O(n log n).
/// @returns the marks that have got a new number, of a new revision.
std::vector<Mark> NumberApart(std::span<Mark> marks);

/// Marks of several sources as one list: of each id the newest, and no two under one number.
std::vector<Mark> Merged(std::span<const Mark> marks);

}  // namespace qwsm::team
