// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/mapper.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace qwsm {
namespace {

constexpr double kReferenceReach_m = 0.2;    // Stored points this near are what a scan matched.
constexpr double kReferenceSpacing_m = 0.3;  // Enough to tell which scans they came from.

ScanLocatorOptions LocatorOptions(const MapperOptions& options) {
  ScanLocatorOptions locator = options.locator;
  if (options.matcher == MatcherKind::kIcp) {
    locator.matcher.weighting = PairWeighting::kIdentity;
  }
  return locator;
}

// The prediction in the map's frame, uncertain only by the last motion: what a match is fused with.
UncertainPose2 MotionInMap(const Pose2& T_map_last, const UncertainPose2& last_robot) {
  return UncertainPose2{.T_a_b = T_map_last} * last_robot;
}

// Covariance of a matched pose: as uncertain as the part of the map it was matched to, plus what is
// left of its uncertainty relative to that part. Where the pairs say nothing, as along a corridor,
// that is all of the prediction's.
Eigen::Matrix3d FuseWithReference(const Eigen::Matrix3d& reference,
                                  const Eigen::Matrix3d& predicted,
                                  const Eigen::Matrix3d& motion,
                                  const Eigen::Matrix3d& pair_information) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> excess(predicted - motion - reference);
  const Eigen::Matrix3d relative = excess.eigenvectors() *
                                       excess.eigenvalues().cwiseMax(0.0).asDiagonal() *
                                       excess.eigenvectors().transpose() +
                                   motion;
  return reference + (pair_information + relative.inverse()).inverse();
}

std::vector<Eigen::Vector2d> ToMap(std::span<const Eigen::Vector2d> points_robot_m,
                                   const Pose2& T_map_robot) {
  std::vector<Eigen::Vector2d> points_map_m;
  points_map_m.reserve(points_robot_m.size());
  for (const Eigen::Vector2d& p_robot : points_robot_m)
    points_map_m.push_back(T_map_robot * p_robot);
  return points_map_m;
}

}  // namespace

std::string_view Name(StepStatus status) {
  switch (status) {
    case StepStatus::kFirst:
      return "first";
    case StepStatus::kMatched:
      return "matched";
    case StepStatus::kExtended:
      return "extended";
    case StepStatus::kDeadReckoned:
      return "dead-reckoned";
  }
  return "unknown";
}

Mapper::Mapper(const MapperOptions& options)
    : options_(options),
      motion_(options.motion),
      locator_(LocatorOptions(options)),
      map_(options.map),
      recent_(options.surroundings) {}

Mapper::Mapper(const MapperOptions& options, ScanMap map, const UncertainPose2& map_robot)
    : options_(options),
      motion_(options.motion),
      locator_(LocatorOptions(options)),
      map_(std::move(map)),
      recent_(options.surroundings),
      map_last_(map_robot),
      T_map_relevant_(map_robot.T_a_b) {}

MappingStep Mapper::Process(const Observation& observation) {
  const std::vector<ScanPoint> points = ToPoints(observation.scan);
  if (map_.empty()) return Begin(observation, points);

  const UncertainPose2 last_robot = motion_.Predict(observation.T_odom_robot);
  const UncertainPose2 predicted = MotionInMap(map_last_.T_a_b, last_robot);
  MappingStep step{.stamp = observation.scan.stamp};
  step.match = locator_.Locate(map_, points, predicted);
  step.map_robot = map_last_ * last_robot;
  Judge(points, predicted.covariance, step);
  if (options_.extend_map && IsRelevant(step)) Extend(observation, points, step);

  motion_.Remember(map_last_.T_a_b.Inverse() * step.map_robot.T_a_b, observation.T_odom_robot);
  map_last_ = step.map_robot;
  return step;
}

MappingStep Mapper::Begin(const Observation& observation, std::span<const ScanPoint> points) {
  // The first pose is the odometry's, so that both frames begin together.
  MappingStep step{.stamp = observation.scan.stamp, .reason = "first scan"};
  step.map_robot.T_a_b = observation.T_odom_robot.value_or(Pose2{});
  step.match.T_ref_cur = step.map_robot.T_a_b;
  if (!points.empty()) Extend(observation, points, step);
  motion_.Remember({}, observation.T_odom_robot);
  map_last_ = step.map_robot;
  return step;
}

// Matched well: the match is the pose. Overlap low: the pose, and the map is extended. Bad: dead
// reckoning (Visser et al. 2009, section 4).
void Mapper::Judge(std::span<const ScanPoint> points,
                   const Eigen::Matrix3d& motion_covariance,
                   MappingStep& step) const {
  const MatchResult& match = step.match;
  const bool found =
      match.status == MatchStatus::kConverged || match.status == MatchStatus::kIterationLimit;
  if (!found || match.overlap < options_.min_overlap) {
    step.status = StepStatus::kDeadReckoned;
    step.reason = found ? "too little of the scan agrees with the map" : Name(match.status);
    return;
  }
  const bool extends = match.overlap < options_.extend_below_overlap;
  step.status = extends ? StepStatus::kExtended : StepStatus::kMatched;
  step.reason = extends ? "much of the scan is new" : "agrees with the map";

  const std::vector<Eigen::Vector2d> points_map =
      ToMap(ThinOut(points, kReferenceSpacing_m), match.T_ref_cur);
  const FrameCovariance reference = map_.CovarianceAround(points_map, kReferenceReach_m);
  const Eigen::Matrix3d independent = match.information * options_.drift_information;
  step.map_robot.covariance = FuseWithReference(reference.At(match.T_ref_cur.translation_m()),
                                                step.map_robot.covariance,
                                                motion_covariance,
                                                independent);
  const double floor_m2 = options_.match_floor_m * options_.match_floor_m;
  const double floor_rad2 = options_.match_floor_rad * options_.match_floor_rad;
  step.map_robot.covariance.diagonal() += Eigen::Vector3d(floor_m2, floor_m2, floor_rad2);
  step.map_robot.T_a_b = match.T_ref_cur;
}

bool Mapper::IsRelevant(const MappingStep& step) const {
  const Pose2 moved = T_map_relevant_.Inverse() * step.map_robot.T_a_b;
  return moved.translation_m().norm() > options_.relevant_translation_m ||
         std::abs(moved.theta_rad) > options_.relevant_rotation_rad;
}

void Mapper::Extend(const Observation& observation,
                    std::span<const ScanPoint> points,
                    MappingStep& step) {
  recent_.Add(step.map_robot.T_a_b, points);
  if (options_.matcher == MatcherKind::kQWsm) {
    if (const auto back = locator_.FindReturn(
            map_, points, recent_.PointsAround(step.map_robot.T_a_b), step.map_robot)) {
      step.match = *back;
      step.reason = "back at a known place";
      step.map_robot.T_a_b = back->T_ref_cur;
      step.map_robot.covariance = back->covariance;
      recent_.Clear();
    }
  } else {
    map_.ForgetPoints();
  }
  map_.Insert(observation.scan, points, step.map_robot);
  T_map_relevant_ = step.map_robot.T_a_b;
  step.relevant = true;
}

}  // namespace qwsm
