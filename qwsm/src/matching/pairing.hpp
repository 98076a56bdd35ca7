// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/matching/surface_map.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

// What is left of the error of the first guess while annealing: the errors of pairs are inflated by
// it, less from iteration to iteration, so that at first all pairs are plausible and a poor first
// guess does not make outliers of the true ones.
struct AnnealedError {
  StartError sigma;

  bool IsZero() const { return sigma.translation_m == 0.0 && sigma.rotation_rad == 0.0; }
  // Variance of the position of a point at that range.
  double Variance_m2(double range_m) const;
  void Anneal(double factor);
};

// How a pull at a point moves the pose, H^T g, for arm = R u: H = [ I | J R u ] with
// J = [ 0 -1; 1 0 ] is the derivative of R u + t by (x, y, theta).
inline Eigen::Vector3d PullOnPose(const Eigen::Vector2d& g, const Eigen::Vector2d& arm) {
  return {g.x(), g.y(), arm.x() * g.y() - arm.y() * g.x()};
}

// Normal equations of the weighted least squares, A step = b, for a step of (x, y, theta): A is the
// sum of H^T S^-1 H and b that of H^T S^-1 e over the pairs, S being the error of a pair and
// e = m - (R u + t) what Visser et al. (2009) call epsilon in Eq. (1). Pfister et al. (2002)
// alternate between translation and rotation instead; the optimum is the same.
struct NormalEquations {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  int pairs = 0;
  double inliers = 0.0;  // As many that lie apart.
  double sum_of_distances_m = 0.0;
  double sum_of_weights = 0.0;
  double weighted_chi2 = 0.0;  // Sum of the squared errors, weighted, each over its variance.

  // A pair that tells the position of its point.
  // @param information inverse of the pair's error, S^-1.
  // @param arm the point in map axes, from the robot: R u.
  void AddPoint(const Eigen::Matrix2d& information,
                const Eigen::Vector2d& error,
                const Eigen::Vector2d& arm);
  // A pair that tells the distance of its point from a line.
  void AddLine(double information,
               const Eigen::Vector2d& normal,
               double error_m,
               const Eigen::Vector2d& arm);
};

// The pairs of one scan with a map, kept from iteration to iteration.
class Pairing {
 public:
  // Keeps references: all arguments outlive the pairing.
  Pairing(const SurfaceMap& map,
          std::span<const ScanPoint> points,
          double max_drift_m2,
          const WeightedScanMatcherOptions& options);

  // Pairs every point, seen from the pose, with the surface nearest to it.
  NormalEquations Linearize(const Pose2& T_map_cur, const AnnealedError& start_error);

  // How many points of the scan lie apart.
  double points_apart() const { return points_apart_; }

  // A of the pairs found last, of the normals that both the map and the scan show: the noise of one
  // is not that of the other, so that it does not pass for information.
  Eigen::Matrix3d ConfirmedInformation(const Pose2& T_map_cur) const;

  // Covariance of b of the pairs found last, by what the readings miss the surfaces by.
  Eigen::Matrix3d Scatter(const Pose2& T_map_cur) const;

  // A of the pairs found last, were each the nearest sample as in Visser et al. (2009), Eq. (3).
  Eigen::Matrix3d NearestSampleInformation(const Pose2& T_map_cur) const;

 private:
  struct Pair {
    // Written, not defaulted: else all of it is set to 0 before its members are.
    Pair() {}

    Eigen::Vector2d arm;        // The scan's point in map axes, from the robot.
    Eigen::Vector2d p_map;      // The same point in the map.
    double inflation_m2 = 0.0;  // Of the pair's error, while annealing.
    SearchCursor cursor;
    std::optional<Neighbor> nearest;
    std::optional<Eigen::Vector2d> mean_near_m;  // There, once it was asked for.
    std::optional<PointId> id;                   // The stored point it is paired with.
    double share = 1.0;                          // Of its point: none where another was selected.
    Surface surface;                             // The surface at that point.
    double weight = 1.0;                         // Of the robust estimate.
    double news = 1.0;                           // Of the scan's point beside the one before.
  };

  void FindNearest(const Pose2& T_map_cur, const AnnealedError& start_error);
  void FindSurface(const Eigen::Matrix2d& R_map_cur, const ScanPoint& point, Pair& pair) const;
  void SelectOneToOne(const Eigen::Matrix2d& R_map_cur);
  static bool IsBeyondEnd(const Eigen::Matrix2d& R_map_cur,
                          const ScanPoint& point,
                          const Pair& pair);
  void AddLine(const Eigen::Matrix2d& R_map_cur,
               const ScanPoint& point,
               Pair& pair,
               NormalEquations& equations) const;
  Eigen::Vector2d ErrorOfLike(const Eigen::Matrix2d& R_map_cur,
                              const ScanPoint& point,
                              Pair& pair) const;
  bool ComparesNear(const Eigen::Matrix2d& R_map_cur,
                    const ScanPoint& point,
                    const Surface& surface) const;
  void AddObject(const Eigen::Matrix2d& R_map_cur,
                 const ScanPoint& point,
                 Pair& pair,
                 NormalEquations& equations) const;
  void Weigh(double mahalanobis2, Pair& pair, NormalEquations& equations) const;
  struct CountedPair;
  template <class Visit>
  void ForEachPair(const Pose2& T_map_cur, Visit visit) const;
  double Reach(double inflation_m2) const;
  Eigen::Matrix2d NoiseInMap(const Eigen::Matrix2d& R_map_cur, const ScanPoint& point) const;
  double Extent_m2(const ScanPoint& point) const;
  bool MayPair(PointId id, const Eigen::Vector2d& normal_map) const;

  const SurfaceMap& map_;
  std::span<const ScanPoint> points_;
  std::uint8_t max_drift_code_;
  const WeightedScanMatcherOptions& options_;
  std::vector<Pair> pairs_;
  double points_apart_ = 0.0;
};

}  // namespace qwsm
