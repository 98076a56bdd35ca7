// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/truth_report.hpp"

#include <cmath>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/metrics/pose_lookup.hpp"
#include "qwsm/metrics/trajectory_error.hpp"

namespace qwsm::pipeline {
namespace {

constexpr std::chrono::milliseconds kTolerance(10);

/// An estimate and what was true at that moment, both in the frame `map`.
struct Comparison {
  const io::PathPose* estimate;
  Pose2 T_map_true;
};

std::vector<Comparison> Pairs(std::span<const io::PathPose> path, const Trajectory& true_in_map) {
  std::vector<Comparison> pairs;
  for (const io::PathPose& pose : path) {
    const auto nearest = NearestIndex(true_in_map, pose.stamp, kTolerance);
    if (nearest) pairs.push_back({&pose, true_in_map[*nearest].T_map_robot});
  }
  return pairs;
}

}  // namespace

std::optional<Pose2> TrueMapInWorld(std::span<const io::PathPose> path, const Trajectory& truth) {
  const Trajectory sorted = SortedByStamp(truth);
  for (const io::PathPose& pose : path) {
    const auto nearest = NearestIndex(sorted, pose.stamp, kTolerance);
    if (nearest) return sorted[*nearest].T_map_robot * pose.map_robot.T_a_b.Inverse();
  }
  return std::nullopt;
}

Trajectory TruthInMap(const Trajectory& truth, const Pose2& T_world_map) {
  Trajectory in_map = SortedByStamp(truth);
  const Pose2 T_map_world = T_world_map.Inverse();
  for (StampedPose2& pose : in_map) pose.T_map_robot = T_map_world * pose.T_map_robot;
  return in_map;
}

std::optional<TruthReport> CompareWithTruth(std::span<const io::PathPose> path,
                                            const Trajectory& truth_in_map) {
  const std::vector<Comparison> compared = Pairs(path, truth_in_map);
  if (compared.size() < 2) return std::nullopt;

  std::vector<PosePair> pairs;
  std::vector<double> headings_rad;
  std::vector<double> nees;
  for (const auto& [estimate, T_map_true] : compared) {
    const Pose2& T_map_robot = estimate->map_robot.T_a_b;
    pairs.push_back(
        {.stamp = estimate->stamp, .T_ref_robot = T_map_true, .T_map_robot = T_map_robot});
    headings_rad.push_back(std::abs(NormalizeAngle(T_map_robot.theta_rad - T_map_true.theta_rad)));
    if (pairs.size() == 1) continue;
    if (const auto value = Nees(estimate->map_robot, T_map_true)) nees.push_back(*value);
  }
  const PosePair& tip = pairs.front();
  const PosePair& tail = pairs.back();
  const Pose2 T_tip_tail_true = tip.T_ref_robot.Inverse() * tail.T_ref_robot;
  const Pose2 T_tip_tail = tip.T_map_robot.Inverse() * tail.T_map_robot;
  return TruthReport{
      .poses = pairs.size(),
      .ate_rmse_m = AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse,
      .ate_from_start_rmse_m = AbsoluteTrajectoryError(pairs, Pose2{}).rmse,
      .heading_rmse_rad = Summarize(std::move(headings_rad)).rmse,
      .loop_gap_m = (T_tip_tail.translation_m() - T_tip_tail_true.translation_m()).norm(),
      .nees = SummarizeNees(nees)};
}

}  // namespace qwsm::pipeline
