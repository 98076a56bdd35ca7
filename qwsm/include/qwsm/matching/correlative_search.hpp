// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

struct CorrelativeSearchOptions {
  double prior_cost_points = 0.3;
  int independent_points = 75;
  double lever_m = 15.0;
};

template <class Visitor>
void Describe(Visitor& visit, CorrelativeSearchOptions& o) {
  visit("prior_cost_points",
        o.prior_cost_points,
        {.help =
             "a squared sigma away from the prediction costs as much as this many points that miss",
         .formerly = "prior_points",
         .min = 0,
         .max = 100});
  visit("independent_points",
        o.independent_points,
        {.help = "more points of a scan than these say nothing new", .min = 1, .max = 100000});
  visit("lever_m",
        o.lever_m,
        {.help = "points further than this move by more than a cell per heading step",
         .min = 1,
         .max = 100});
}

/// Positions that a search leaves out.
struct ExcludedDisk {
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;  ///< Positions no further than that from the centre are left out.
};

/// How far a window reaches from its middle.
struct WindowReach {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

/// Describes where to search for a pose.
struct SearchWindow {
  UncertainPose2 predicted;    ///< The prediction; poses cost the more sigmas they are away.
  double translation_m = 0.0;  ///< Half the side of the square of positions.
  double rotation_rad = 0.0;   ///< Half the range of headings.
  double min_score = 0.0;      ///< Poses that score no better are not found.
  std::optional<ExcludedDisk> excluded{};
  /// Where the same points were sought before, about the same prediction: no pose there scores more
  /// than min_score.
  std::optional<WindowReach> searched{};
  /// Surfaces that drifted more do not count; see LikelihoodPyramid::DriftCode().
  std::uint8_t max_drift_code = LikelihoodPyramid::kUnmapped;
};

/// A pose that a search found.
struct FoundPose {
  Pose2 T_map_robot;
  double score = 0.0;  ///< Mean likelihood of the beam ends, 0..1, less the cost of the prior.
};

/// Searches a window for its best pose, by branch and bound (Olson 2009; Hess et al. 2016):
/// exhaustive in steps of a cell and of the heading that moves a far point by a cell. Blocks of
/// positions are bounded at several headings at once, by what each beam meets anywhere in the box
/// it then sweeps. The position is interpolated between the cells at last.
///
/// @param points_robot_m the scan's points in the robot's frame, thinned out: cost is linear in
/// them, and near surfaces, on which beams are dense, would outvote the rest.
/// @return nothing if no pose of the window scores above `window.min_score`.
std::optional<FoundPose> SearchPose(const LikelihoodPyramid& map,
                                    std::span<const Eigen::Vector2d> points_robot_m,
                                    const SearchWindow& window,
                                    const CorrelativeSearchOptions& options);

/// Several searches of one window, which differ in what they leave out: what the first one learned
/// about the window serves them all.
class PoseSearch {
 public:
  /// Keeps references to tiles of the map, which must not change meanwhile. The arguments are those
  /// of SearchPose().
  PoseSearch(const LikelihoodPyramid& map,
             std::span<const Eigen::Vector2d> points_robot_m,
             const SearchWindow& window,
             const CorrelativeSearchOptions& options);
  PoseSearch(PoseSearch&&) noexcept;
  PoseSearch& operator=(PoseSearch&&) noexcept;
  ~PoseSearch();

  /// The best pose of the window that scores above `min_score` and is not excluded.
  std::optional<FoundPose> Best(double min_score, const std::optional<ExcludedDisk>& excluded = {});

 private:
  class BranchAndBound;
  std::unique_ptr<BranchAndBound> search_;  // None where there are no points.
};

}  // namespace qwsm
