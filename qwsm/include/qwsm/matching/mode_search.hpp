// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/search/coarse_likelihood.hpp"
#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

/// Where in a map poses are searched for of which nothing else is known, and upper bounds of the
/// likelihoods there. To make it takes longer than a search: it serves for any number of them, as
/// long as the map stays as it is.
class ModeSearchArea {
 public:
  /// @param places_m positions to search around, at any heading. @param reach_m how far around
  /// each.
  ModeSearchArea(const LikelihoodPyramid& map,
                 std::span<const Eigen::Vector2d> places_m,
                 double reach_m);

  /// Places near to each other, and the map around them: maps may reach from one end of a town to
  /// the other with nothing between.
  struct District {
    std::vector<Eigen::Vector2d> places_m;
    std::shared_ptr<const CoarseLikelihood> likelihood;
  };

  /// The same area but for the places within a circle.
  ModeSearchArea Without(const Eigen::Vector2d& center_m, double radius_m) const;

  double reach_m() const { return reach_m_; }
  std::span<const District> districts() const { return districts_; }

 private:
  double reach_m_;
  std::vector<District> districts_;  // None without places.
};

/// Which poses of an area are searched for.
struct ModeSearchLimits {
  double min_score = 0.0;  ///< Poses that score no better are not found.
  double margin = 0.0;     ///< Poses that score this much less than the best one are not found.
  double known_score = 0.0;  ///< So much the best one scores at least, as somebody knows.
};

/// All poses that may be the right one.
struct FoundModes {
  std::vector<FoundPose> modes;  ///< The best one first. Those near a better one are left out.
  /// No other pose scores better. Where places are so much alike that the search was given up, it
  /// may be above the score of the best mode.
  double floor_score = 0.0;
};

/// Searches an area of a map for all poses whose score comes near to that of the best one: global
/// localization. Branch and bound over position and heading together (Olson 2009; Hess et al. 2016
/// branch over the position only): a block is the wider in heading, the wider it is in position.
/// Blocks are visited in the order of their bounds and only near the places given, so that the cost
/// follows the length of the drive and how alike its places are, not the area of the map.
///
/// @param map that the area was made of. @param points_robot_m thinned out, as for SearchPose().
FoundModes SearchModes(const LikelihoodPyramid& map,
                       const ModeSearchArea& area,
                       std::span<const Eigen::Vector2d> points_robot_m,
                       const ModeSearchLimits& limits);

/// The window around a pose in which none is more likely than another: as in the search for modes,
/// or scores could not be compared.
SearchWindow FlatWindow(const Pose2& T_map_robot, double translation_m, double rotation_rad);

}  // namespace qwsm
