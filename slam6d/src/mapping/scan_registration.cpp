// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/scan_registration.hpp"

#include <algorithm>
#include <deque>
#include <vector>

#include "slam6d/src/algebra/decompositions.hpp"
#include "slam6d/src/mapping/open_motions.hpp"
#include "slam6d/src/mapping/sample.hpp"

namespace slam6d {
namespace {

/// Squared deviations from the guess over its variances that one pose in a thousand exceeds: chi2
/// of six degrees of freedom. What slides farther found other surfaces.
constexpr double kMostGuessChi2 = 22.5;

/// Where planes fail, points are first paired so many times farther off than else: a turn of 15
/// degrees moves what is 5 m away by more than the usual pair is long, and ICP stops on the way.
constexpr double kWidePairsFactor = 3.0;

/// Where points put a scan planes begin only: so many of its points will do, and steps of a
/// millimetre end it. All of them, where nothing overlaps, cost twenty times a registration.
constexpr std::size_t kPointsOfGuess = 3000;
constexpr double kLastStep_m = 1e-3;
constexpr double kLastStep_rad = 1e-4;

/// One registration, tried from several places.
class Attempts {
 public:
  Attempts(std::span<const PlacedScan> references,
           const PlacedScan& cur,
           const Matrix6d& guess_covariance,
           const RegistrationOptions& options)
      : references_(references),
        cur_(cur),
        guess_{.T_a_b = cur.T_map_scan, .covariance = guess_covariance},
        options_(options) {
    for (const PlacedScan& scan : references) {
      models_.push_back({.model = scan.model, .T_map_ref = scan.T_map_scan});
      images_.push_back({.image = scan.image, .T_map_ref = scan.T_map_scan});
    }
  }

  Registration From(const Pose3& T_map_cur) const {
    const PoseAndGuess start{.now = T_map_cur, .guess = guess_};
    Registration result{.icp = Align(models_, *cur_.model, start, options_.icp)};
    result.agreement = Compare(images_, *cur_.image, result.icp.T_ref_cur);
    result.convinces =
        HasPose(result.icp) && IsWithinReach(result.icp.T_ref_cur) && IsBorneOut(result.agreement);
    return result;
  }

  /// The same, with what the error of the guess does where it has to tell.
  Registration WithErrorOfGuess(Registration registration) const {
    const OpenMotions open(registration.icp, guess_, options_.icp);
    if (registration.convinces && !open.empty()) {
      registration.open_motions = open.size();
      registration.icp.covariance = open.Covariance(models_, *cur_.model);
    }
    return registration;
  }

  /// Whether nothing speaks for trying elsewhere: pairs that change to and fro for ever may be
  /// those of a wrong place, and what they leave open may be held elsewhere.
  bool IsSettled(const Registration& registration) const {
    return registration.convinces && registration.icp.status == IcpStatus::kConverged &&
           OpenMotions(registration.icp, guess_, options_.icp).empty();
  }

  Pose3 GuessByOctrees() const {
    std::deque<OverlapModel> models;
    std::vector<OverlapReference> cubes;
    for (const PlacedScan& scan : references_) {
      models.emplace_back(scan.model->points, options_.guess);
      cubes.push_back({.model = &models.back(), .T_map_ref = scan.T_map_scan});
    }
    const OverlapModel cur(cur_.model->points, options_.guess);
    return GuessByOverlap(cubes, cur, cur_.T_map_scan, options_.guess).T_map_cur;
  }

  /// Points find together from far off; planes have the last word, as only their pairs tell what
  /// they leave open.
  Registration ByPoints() const {
    IcpOptions points = options_.icp;
    points.metric = IcpMetric::kPointToPoint;
    points.max_distance_m *= kWidePairsFactor;
    points.translation_tolerance_m = std::max(points.translation_tolerance_m, kLastStep_m);
    points.rotation_tolerance_rad = std::max(points.rotation_tolerance_rad, kLastStep_rad);
    const ScanModel sample(Sample(cur_.model->points, kPointsOfGuess));
    const IcpResult found = Align(models_, sample, cur_.T_map_scan, points);
    Registration result = From(found.T_ref_cur);
    result.icp.search += found.search;
    return result;
  }

 private:
  static bool HasPose(const IcpResult& result) {
    return result.status == IcpStatus::kConverged || result.status == IcpStatus::kIterationLimit;
  }

  bool IsWithinReach(const Pose3& T_map_cur) const {
    const Vector6d error = Difference(T_map_cur, guess_.T_a_b);
    return error.dot(SolvePositive(guess_.covariance, error)) <= kMostGuessChi2;
  }

  /// Scans of which neither tells anything of the other's points may be anywhere.
  bool IsBorneOut(const Agreement& agreement) const {
    return agreement.told() > 0 && agreement.Contradiction() <= options_.evidence.max_contradiction;
  }

  std::span<const PlacedScan> references_;
  const PlacedScan& cur_;
  const UncertainPose3 guess_;
  const RegistrationOptions& options_;
  std::vector<IcpReference> models_;
  std::vector<RangeImageReference> images_;
};

/// As if either pose could be the true one.
Matrix6d SpreadOf(const Pose3& a, const Pose3& b) {
  const Vector6d apart = Difference(b, a);
  return apart * apart.transpose();
}

/// Of two, the one that convinces; if both do, the one that sees more of what the references saw.
/// Where the pairs of that one never settled it may be the other all the same.
Registration BetterOf(const Registration& a, const Registration& b) {
  const bool sees_more = a.convinces && b.agreement.Overlap() > a.agreement.Overlap();
  const bool is_second = a.convinces == b.convinces ? sees_more : b.convinces;
  Registration better = is_second ? b : a;
  const Registration& other = is_second ? a : b;
  better.icp.search += other.icp.search;
  if (other.convinces && better.icp.status == IcpStatus::kIterationLimit) {
    better.icp.covariance += SpreadOf(better.icp.T_ref_cur, other.icp.T_ref_cur);
  }
  return better;
}

}  // namespace

Registration RegisterScan(std::span<const PlacedScan> references,
                          const PlacedScan& cur,
                          const Matrix6d& guess_covariance,
                          const RegistrationOptions& options) {
  const Attempts attempts(references, cur, guess_covariance, options);
  const Registration first = attempts.From(cur.T_map_scan);
  if (attempts.IsSettled(first)) return first;
  const Registration second = attempts.From(attempts.GuessByOctrees());
  if (options.icp.metric == IcpMetric::kPointToPoint) return BetterOf(first, second);
  if (attempts.IsSettled(second)) {
    return attempts.WithErrorOfGuess(BetterOf(first, second));
  }
  const Registration third = attempts.ByPoints();
  return attempts.WithErrorOfGuess(BetterOf(BetterOf(first, second), third));
}

}  // namespace slam6d
