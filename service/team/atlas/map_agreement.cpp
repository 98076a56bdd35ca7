// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/map_agreement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "qwsm/mapping/place_evidence.hpp"

namespace qwsm::team {
namespace {

constexpr double kBeside_m = 5.0;  // Scans farther off see little of what the other map shows.
constexpr double kBetweenScans_m = 1.0;  // Scans nearer to each other see the same,
constexpr double kNewInAScan = 0.4;      // and of what the next one tells so much is new.
constexpr double kSpacing_m = 0.15;      // Points nearer to each other count once.
constexpr double kExplained = 0.7;       // Of a scan that says where the map is.
// By how much two maps may be bent against each other, beside what is known of that.
constexpr double kBent_m = 0.2;
constexpr double kBent_rad = 0.03;
// In places that look alike more points than in one and the same are seen through, by as many.
constexpr double kDiffers = 0.05;

bool IsBeside(const Eigen::Vector2d& p_m, const std::vector<Eigen::Vector2d>& path_m) {
  return std::ranges::any_of(
      path_m, [&](const Eigen::Vector2d& there_m) { return (there_m - p_m).norm() < kBeside_m; });
}

// The scans of a map near another one's, each of which sees something that those before do not.
std::vector<const RelevantScan*> ScansBeside(const ScanMap& map,
                                             const ScanMap& other,
                                             const Pose2& T_other_map) {
  const std::vector<Eigen::Vector2d> path_m = PathOf(other);
  std::vector<const RelevantScan*> spread;
  for (const RelevantScan& scan : map.scans()) {
    const Eigen::Vector2d p_m = scan.map_robot.T_a_b.translation_m();
    const bool sees_the_same = std::ranges::any_of(spread, [&](const RelevantScan* one) {
      return (one->map_robot.T_a_b.translation_m() - p_m).norm() < kBetweenScans_m;
    });
    if (!sees_the_same && IsBeside(T_other_map * p_m, path_m)) spread.push_back(&scan);
  }
  return spread;
}

}  // namespace

UncertainPose2 Inverse(const UncertainPose2& a_b) {
  const Pose2 T_b_a = a_b.T_a_b.Inverse();
  Eigen::Matrix3d d_b_a = -Eigen::Matrix3d::Identity();
  d_b_a.topLeftCorner<2, 2>() = -Eigen::Rotation2Dd(T_b_a.theta_rad).toRotationMatrix();
  // A turn about the origin of b moves that of a around it.
  d_b_a.topRightCorner<2, 1>() << T_b_a.y_m, -T_b_a.x_m;
  return {.T_a_b = T_b_a, .covariance = d_b_a * a_b.covariance * d_b_a.transpose()};
}

void MapAgreement::Fates::Add(const Fates& other) {
  known += other.known;
  seen_through += other.seen_through;
}

MapAgreement::Judgement MapAgreement::Judge(const ScanMap& a,
                                            const ScanMap& b,
                                            const UncertainPose2& a_b) const {
  const UncertainPose2 b_a = Inverse(a_b);
  const std::vector<const RelevantScan*> of_a = ScansBeside(a, b, b_a.T_a_b);
  const std::vector<const RelevantScan*> of_b = ScansBeside(b, a, a_b.T_a_b);
  Fates in_other = FatesOf(of_b, a, a_b);
  in_other.Add(FatesOf(of_a, b, b_a));
  Fates in_own = FatesOf(of_a, a, {});
  in_own.Add(FatesOf(of_b, b, {}));
  const double if_right = (in_own.seen_through + 1.0) / (in_own.known + 2.0);
  const double if_alike = std::min(if_right + kDiffers, 1.0);
  const double not_seen_through = in_other.known - in_other.seen_through;
  return {.nats = in_other.seen_through * std::log(if_right / if_alike) +
                  not_seen_through * std::log((1.0 - if_right) / (1.0 - if_alike)),
          .a_b = Fit(a_b, in_other.pairs)};
}

// Weighted least squares of where the scans are found against where they are in their own map.
UncertainPose2 MapAgreement::Fit(const UncertainPose2& a_b, std::span<const Pair> pairs) {
  if (pairs.empty()) return a_b;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  for (const Pair& pair : pairs) {
    const Pose2& found = pair.match.T_ref_cur;
    Eigen::Matrix3d d_scan = Eigen::Matrix3d::Identity();  // By a small motion of b in a.
    d_scan.topRightCorner<2, 1>() << -pair.T_a_scan.y_m, pair.T_a_scan.x_m;
    const Eigen::Vector3d off(found.x_m - pair.T_a_scan.x_m,
                              found.y_m - pair.T_a_scan.y_m,
                              NormalizeAngle(found.theta_rad - pair.T_a_scan.theta_rad));
    const Eigen::Matrix3d weight = pair.match.covariance.inverse();
    information += d_scan.transpose() * weight * d_scan;
    pull += d_scan.transpose() * weight * off;
  }
  const Eigen::Vector3d motion = information.ldlt().solve(pull);
  const Pose2 T_a_moved{.x_m = motion.x(), .y_m = motion.y(), .theta_rad = motion.z()};
  return {.T_a_b = T_a_moved * a_b.T_a_b, .covariance = a_b.covariance};
}

MapAgreement::Fates MapAgreement::FatesOf(std::span<const RelevantScan* const> scans,
                                          const ScanMap& map,
                                          const UncertainPose2& map_scans) const {
  PlaceEvidence evidence(free_space_);
  const UncertainPose2 bent = UncertainPose2::WithSigmas({}, kBent_m, kBent_rad);
  Fates fates;
  for (const RelevantScan* scan : scans) {
    const std::vector<ScanPoint> points = ThinOut(ToPoints(scan->scan), kSpacing_m);
    const UncertainPose2 predicted = map_scans * UncertainPose2{.T_a_b = scan->map_robot.T_a_b};
    const MatchResult match = locator_.Locate(map, points, predicted * bent);
    const PlaceFit fit = evidence.Weigh(map, points, match);
    const double telling = kNewInAScan * fit.told;
    fates.known += telling * (fit.explained + fit.seen_through);
    fates.seen_through += telling * fit.seen_through;
    if (fit.explained > kExplained) fates.pairs.push_back({predicted.T_a_b, match});
  }
  return fates;
}

}  // namespace qwsm::team
