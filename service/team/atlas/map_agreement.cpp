// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/map_agreement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "qwsm/geometry/moments.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "service/team/atlas/map_echoes.hpp"

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

// How large a share of the points is seen through, as beta distributions: in places that only look
// alike 20 % of them (6 % to 40 %), as was measured at 2200 of those that robots thought of in
// simulated offices and in parts of intel, aces and mit-csail (docs/experiments.md); where two maps
// go together as in the maps themselves, and one in fifty before anything is known of these.
struct MapAgreement::Share {
  double seen_through;
  double explained;

  static Share IfAlike() { return {.seen_through = 3.75, .explained = 15.0}; }
  static Share InOneMap() { return {.seen_through = 1.0, .explained = 50.0}; }

  /// As it is known once these were seen, too.
  Share Having(const Fates& seen) const {
    return {.seen_through = seen_through + seen.seen_through,
            .explained = explained + seen.explained};
  }
  /// Logarithm of the probability that so many are.
  double LogLikelihood(const Fates& of_points) const {
    const Share after = Having(of_points);
    return LogBeta(after.seen_through, after.explained) - LogBeta(seen_through, explained);
  }
  static double LogBeta(double a, double b) {
    return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
  }
};

struct MapAgreement::Evidence {
  Overlap overlap;
  Fates b_in_a;
  Fates a_in_b;
  Fates found;  // All of these, each told once.
  Share if_right;

  double NatsAgainst(const Share& other) const {
    return if_right.LogLikelihood(found) - other.LogLikelihood(found);
  }
};

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
                                            const UncertainPose2& a_b,
                                            const std::stop_token& stop) const {
  const Evidence evidence = EvidenceOf(a, b, a_b, stop);
  const Fitted fitted = Fit(a_b, evidence.b_in_a.pairs, evidence.a_in_b.pairs);
  return {.nats = evidence.NatsAgainst(Share::IfAlike()),
          .a_b = fitted.a_b,
          .least_known = fitted.least_known};
}

double MapAgreement::NatsAmongEchoes(const ScanMap& a,
                                     const ScanMap& b,
                                     const UncertainPose2& a_b,
                                     const std::stop_token& stop) const {
  const Evidence evidence = EvidenceOf(a, b, a_b, stop);
  const UncertainPose2 b_a = Inverse(a_b);
  double nats = evidence.NatsAgainst(Share::IfAlike());
  const auto consider = [&](const Fates& echo) {
    nats = std::min(nats, evidence.NatsAgainst(Share::IfAlike().Having(echo)));
  };
  for (const Pose2& T_a_a : FindEchoes(evidence.overlap.of_a, a, stop)) {
    const UncertainPose2 echo{.T_a_b = T_a_a};
    consider(FatesOfBoth(evidence.overlap, a, echo, echo * a_b, stop));
  }
  for (const Pose2& T_b_b : FindEchoes(evidence.overlap.of_b, b, stop)) {
    const UncertainPose2 echo{.T_a_b = T_b_b};
    consider(FatesOfBoth(evidence.overlap, b, echo * b_a, echo, stop));
  }
  return nats;
}

std::vector<Pose2> MapAgreement::InSteadOf(const ScanMap& b,
                                           const ScanMap& a,
                                           const UncertainPose2& a_b,
                                           const ScanMap& third,
                                           const std::stop_token& stop) const {
  std::vector<Pose2> T_b_third = FindLikenesses(ScansBeside(b, a, a_b.T_a_b), third, stop);
  std::ranges::transform(T_b_third, T_b_third.begin(), &Pose2::Inverse);
  return T_b_third;
}

MapAgreement::Evidence MapAgreement::EvidenceOf(const ScanMap& a,
                                                const ScanMap& b,
                                                const UncertainPose2& a_b,
                                                const std::stop_token& stop) const {
  const UncertainPose2 b_a = Inverse(a_b);
  Overlap overlap{.of_a = ScansBeside(a, b, b_a.T_a_b), .of_b = ScansBeside(b, a, a_b.T_a_b)};
  Fates b_in_a = FatesOf(overlap.of_b, a, a_b, stop);
  Fates a_in_b = FatesOf(overlap.of_a, b, b_a, stop);
  Fates found;
  found.Add(b_in_a, OnceTold(overlap.of_b.size(), overlap.of_a.size()));
  found.Add(a_in_b, OnceTold(overlap.of_a.size(), overlap.of_b.size()));
  Fates in_own;
  in_own.Add(FatesOf(overlap.of_a, a, {}, stop), 1.0);
  in_own.Add(FatesOf(overlap.of_b, b, {}, stop), 1.0);
  return {.overlap = std::move(overlap),
          .b_in_a = std::move(b_in_a),
          .a_in_b = std::move(a_in_b),
          .found = std::move(found),
          .if_right = Share::InOneMap().Having(in_own)};
}

// Where the scans of an overlap were taken in one map, as if both maps lay there.
MapAgreement::Fates MapAgreement::FatesOfBoth(const Overlap& overlap,
                                              const ScanMap& map,
                                              const UncertainPose2& map_a,
                                              const UncertainPose2& map_b,
                                              const std::stop_token& stop) const {
  const std::size_t of_a = overlap.of_a.size();
  const std::size_t of_b = overlap.of_b.size();
  Fates both;
  both.Add(FatesOf(overlap.of_a, map, map_a, stop), OnceTold(of_a, of_b));
  both.Add(FatesOf(overlap.of_b, map, map_b, stop), OnceTold(of_b, of_a));
  return both;
}

// Weighted least squares of where the scans are found against where they are in their own map. That
// those of a are off in b means that b is off the other way.
MapAgreement::Fitted MapAgreement::Fit(const UncertainPose2& a_b,
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
  if (b_in_a.empty() && a_in_b.empty()) return {a_b, Eigen::Vector2d::UnitX()};
  const Eigen::Vector3d motion = information.ldlt().solve(pull);
  const Pose2 T_a_moved{.x_m = motion.x(), .y_m = motion.y(), .theta_rad = motion.z()};
  const PrincipalAxes known =
      PrincipalAxesOf(information(0, 0), information(0, 1), information(1, 1));
  return {.a_b = {.T_a_b = T_a_moved * a_b.T_a_b, .covariance = a_b.covariance},
          .least_known = known.minor_axis};
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
                                          const UncertainPose2& map_scans,
                                          const std::stop_token& stop) const {
  PlaceEvidence evidence(free_space_);
  const UncertainPose2 bent = UncertainPose2::WithSigmas({}, kBent_m, kBent_rad);
  Fates fates;
  for (const RelevantScan* scan : scans) {
    if (stop.stop_requested()) break;
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
