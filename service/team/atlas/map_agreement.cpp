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
// How large a share of the points is seen through, as beta distributions: in places that only look
// alike 20 % of them (6 % to 40 %), as was measured at 2200 of those that robots thought of in
// simulated offices and in parts of intel, aces and mit-csail (docs/experiments.md); where two maps
// go together as in the maps themselves, and one in fifty before anything is known of these.
struct Share {
  double seen_through;
  double explained;

  /// Logarithm of the probability that so many are.
  double LogLikelihood(const Share& of_points) const {
    return LogBeta(seen_through + of_points.seen_through, explained + of_points.explained) -
           LogBeta(seen_through, explained);
  }
  static double LogBeta(double a, double b) {
    return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
  }
};
constexpr Share kIfAlike{.seen_through = 3.75, .explained = 15.0};
constexpr Share kInOneMap{.seen_through = 1.0, .explained = 50.0};

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

// Many scans of one map see the same of another one that has few.
double OnceTold(std::size_t scans, std::size_t scans_of_other) {
  return scans > scans_of_other ? static_cast<double>(scans_of_other) / static_cast<double>(scans)
                                : 1.0;
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

void MapAgreement::Fates::Add(const Fates& other, double share) {
  explained += share * other.explained;
  seen_through += share * other.seen_through;
}

MapAgreement::Judgement MapAgreement::Judge(const ScanMap& a,
                                            const ScanMap& b,
                                            const UncertainPose2& a_b) const {
  const UncertainPose2 b_a = Inverse(a_b);
  const std::vector<const RelevantScan*> of_a = ScansBeside(a, b, b_a.T_a_b);
  const std::vector<const RelevantScan*> of_b = ScansBeside(b, a, a_b.T_a_b);
  const Fates of_b_in_a = FatesOf(of_b, a, a_b);
  const Fates of_a_in_b = FatesOf(of_a, b, b_a);
  Fates in_other;
  in_other.Add(of_b_in_a, OnceTold(of_b.size(), of_a.size()));
  in_other.Add(of_a_in_b, OnceTold(of_a.size(), of_b.size()));
  Fates in_own;
  in_own.Add(FatesOf(of_a, a, {}), 1.0);
  in_own.Add(FatesOf(of_b, b, {}), 1.0);
  const Share if_right{.seen_through = kInOneMap.seen_through + in_own.seen_through,
                       .explained = kInOneMap.explained + in_own.explained};
  const Share found{.seen_through = in_other.seen_through, .explained = in_other.explained};
  return {.nats = if_right.LogLikelihood(found) - kIfAlike.LogLikelihood(found),
          .a_b = Fit(a_b, of_b_in_a.pairs, of_a_in_b.pairs)};
}

// Weighted least squares of where the scans are found against where they are in their own map. That
// those of a are off in b means that b is off the other way.
UncertainPose2 MapAgreement::Fit(const UncertainPose2& a_b,
                                 std::span<const Pair> b_in_a,
                                 std::span<const Pair> a_in_b) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  const auto add =
      [&](const Eigen::Vector2d& p_a_m, const Eigen::Vector3d& off, const Eigen::Matrix3d& weight) {
        Eigen::Matrix3d d_scan = Eigen::Matrix3d::Identity();  // By a small motion of b in a.
        d_scan.topRightCorner<2, 1>() << -p_a_m.y(), p_a_m.x();
        information += d_scan.transpose() * weight * d_scan;
        pull += d_scan.transpose() * weight * off;
      };
  for (const Pair& pair : b_in_a) add(pair.T_map_scan.translation_m(), pair.off, pair.information);
  Eigen::Matrix3d R_a_b = Eigen::Matrix3d::Identity();
  R_a_b.topLeftCorner<2, 2>() = a_b.T_a_b.Rotation();
  for (const Pair& pair : a_in_b) {
    add(a_b.T_a_b * pair.T_map_scan.translation_m(),
        -R_a_b * pair.off,
        R_a_b * pair.information * R_a_b.transpose());
  }
  if (b_in_a.empty() && a_in_b.empty()) return a_b;
  const Eigen::Vector3d motion = information.ldlt().solve(pull);
  const Pose2 T_a_moved{.x_m = motion.x(), .y_m = motion.y(), .theta_rad = motion.z()};
  return {.T_a_b = T_a_moved * a_b.T_a_b, .covariance = a_b.covariance};
}

MapAgreement::Pair MapAgreement::PairOf(const Pose2& T_map_scan, const MatchResult& match) {
  const Pose2& found = match.T_ref_cur;
  return {.T_map_scan = T_map_scan,
          .off = {found.x_m - T_map_scan.x_m,
                  found.y_m - T_map_scan.y_m,
                  NormalizeAngle(found.theta_rad - T_map_scan.theta_rad)},
          .information = match.covariance.inverse()};
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
    fates.explained += telling * fit.explained;
    fates.seen_through += telling * fit.seen_through;
    if (fit.explained > kExplained) fates.pairs.push_back(PairOf(predicted.T_a_b, match));
  }
  return fates;
}

}  // namespace qwsm::team
