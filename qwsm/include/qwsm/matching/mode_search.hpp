// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

/// Describes a search for all poses that may be the right one, where nothing is known but the map.
struct ModeSearchWindow {
  std::span<const Eigen::Vector2d> places_m;  ///< Positions to search around, at any heading.
  double reach_m = 2.0;                       ///< How far around each of them.
  double min_score = 0.0;                     ///< Poses that score no better are not found.
  double margin = 0.0;  ///< Poses that score this much less than the best one are not found.
};

/// All poses that may be the right one.
struct FoundModes {
  std::vector<FoundPose> modes;  ///< The best one first. Those near a better one are left out.
  /// No other pose scores better. Where places are so much alike that the search was given up, it
  /// may be above the score of the best mode.
  double floor_score = 0.0;
};

/// Searches a map for all poses whose score comes near to that of the best one: global
/// localization. Branch and bound over position and heading together (Olson 2009; Hess et al. 2016
/// branch over the position only): a block is the wider in heading, the wider it is in position.
/// Blocks are visited in the order of their bounds and only near the places given, so that the cost
/// follows the length of the drive and how alike its places are, not the area of the map.
///
/// @param points_robot_m thinned out, as for SearchPose().
FoundModes SearchModes(const LikelihoodPyramid& map,
                       std::span<const Eigen::Vector2d> points_robot_m,
                       const ModeSearchWindow& window);

/// The window around a pose in which none is more likely than another: as in the search for modes,
/// or scores could not be compared.
SearchWindow FlatWindow(const Pose2& T_map_robot, double translation_m, double rotation_rad);

}  // namespace qwsm
