// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/icp/surfel_pairs.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "slam6d/src/parallel.hpp"

namespace slam6d {
namespace {

constexpr std::size_t kChunkSize = 512;

/// Surfels whose normals differ more than this (37 degrees) are different surfaces.
constexpr double kMinNormalCosine = 0.8;

/// The scale of the residuals starts at half the maximum distance and shrinks to its final value by
/// this factor per iteration: true pairs look like outliers while the guess is poor.
constexpr double kScaleShrink = 0.6;

/// This share of the squared scale joins the variance of each pair: while the scale is wide,
/// surfels count alike; in the end each counts by its own scatter.
constexpr double kScaleShare = 0.04;

/// Below this share of the largest eigenvalue the surfaces leave a motion open.
constexpr double kOpenShare = 1e-9;

PointCloud MeansOf(const SurfelMap& map) {
  PointCloud means;
  means.reserve(map.surfels.size());
  for (const Surfel& surfel : map.surfels) means.push_back(surfel.mean_m);
  return means;
}

bool LeavesMotionOpen(const Matrix6d& A) {
  // Rotations are compared with translations at an arm of the size of the scene.
  const double arm_m = std::sqrt(A.bottomRightCorner<3, 3>().trace() /
                                 std::max(A.topLeftCorner<3, 3>().trace(), 1e-300));
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1.0 / std::max(arm_m, 1e-300));
  const Matrix6d scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(scaled).eigenvalues();
  return !(eigenvalues(0) > kOpenShare * eigenvalues(5));
}

}  // namespace

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  A += other.A;
  b += other.b;
  weighted_residual2 += other.weighted_residual2;
  residual2_m2 += other.residual2_m2;
  pairs += other.pairs;
  settled = settled && other.settled;
  return *this;
}

NormalEquations NormalEquations::In(const Pose3& T_map_ref) const {
  Matrix6d R = Matrix6d::Zero();
  R.topLeftCorner<3, 3>() = T_map_ref.rotation;
  R.bottomRightCorner<3, 3>() = T_map_ref.rotation;
  NormalEquations moved = *this;
  moved.A = R * A * R.transpose();
  moved.b = R * b;
  return moved;
}

SurfelPairs::SurfelPairs(const ScanModel& ref, const ScanModel& cur, const IcpOptions& options)
    : ref_(ref.surfels),
      cur_surfels_(options.metric == IcpMetric::kPlaneToPlane ? &cur.surfels : nullptr),
      options_(options),
      cur_(cur_surfels_ != nullptr ? MeansOf(*cur_surfels_) : cur.points),
      search_(ref.tree,
              cur_.size(),
              {.max_distance_m = options.max_distance_m, .start = options.search}),
      cur_ref_(cur_.size()) {}

void SurfelPairs::AddPair(const Rules& rules, std::size_t i, NormalEquations& equations) const {
  if (!search_.found(i)) return;
  const std::int32_t number = ref_.surfel_of_block[search_.neighbor_slot(i) / kLanes];
  if (number == SurfelMap::kNone) return;
  const Surfel& ref = ref_.surfels[static_cast<std::size_t>(number)];
  Eigen::Vector3d normal = ref.normal;
  double variance_m2 = ref.variance_m2 + options_.surface_noise_m * options_.surface_noise_m;
  if (cur_surfels_ != nullptr) {
    const Surfel& cur = cur_surfels_->surfels[i];
    const Eigen::Vector3d normal_ref = rules.T_ref_cur.rotation * cur.normal;
    const double cosine = ref.normal.dot(normal_ref);
    if (std::abs(cosine) < kMinNormalCosine) return;
    normal = (ref.normal + std::copysign(1.0, cosine) * normal_ref).normalized();
    variance_m2 += cur.variance_m2;
  }
  const Eigen::Vector3d point_m = cur_ref_[i];
  const double residual_m = normal.dot(ref.mean_m - point_m);
  variance_m2 += kScaleShare * rules.scale2_m2;
  // Geman & McClure (1987): weight (1 + r^2 / s^2)^-2.
  const double outlier = 1.0 + residual_m * residual_m / rules.scale2_m2;
  const double weight = 1.0 / (variance_m2 * outlier * outlier);
  Vector6d J;
  J << normal, (point_m - rules.T_ref_cur.translation_m).cross(normal);
  equations.A.noalias() += weight * J * J.transpose();
  equations.b += weight * residual_m * J;
  equations.weighted_residual2 += weight * residual_m * residual_m;
  equations.residual2_m2 += residual_m * residual_m;
  ++equations.pairs;
}

NormalEquations SurfelPairs::Sum(const Rules& rules, std::size_t first, std::size_t last) const {
  NormalEquations equations;
  for (std::size_t i = first; i < last; ++i) AddPair(rules, i, equations);
  return equations;
}

NormalEquations SurfelPairs::Collect(const Pose3& T_ref_cur, int iteration) {
  const double wide_m = 0.5 * options_.max_distance_m * std::pow(kScaleShrink, iteration - 1);
  const double scale_m = std::max(options_.residual_scale_m, wide_m);
  const Rules rules{.T_ref_cur = T_ref_cur, .scale2_m2 = scale_m * scale_m};
  const std::size_t chunks = (cur_.size() + kChunkSize - 1) / kChunkSize;
  std::vector<NormalEquations> sums(chunks);
  std::vector<SearchStatistics> statistics(chunks);
  const auto work = [&](std::size_t chunk, std::size_t first, std::size_t last) {
    TransformRange(T_ref_cur, cur_, first, last, cur_ref_);
    statistics[chunk] = search_.Find(cur_ref_, first, last);
    sums[chunk] = Sum(rules, first, last);
  };
  ForChunks(cur_.size(), kChunkSize, options_.threads, work);
  for (const SearchStatistics& part : statistics) statistics_ += part;
  NormalEquations total;
  for (const NormalEquations& part : sums) total += part;
  total.settled = wide_m <= options_.residual_scale_m;
  information_ = total.A;
  return total;
}

IcpStep SurfelPairs::Step(const Sums& sums, const Pose3& T_map_cur, const IcpOptions&) {
  const double count = static_cast<double>(std::max<std::size_t>(sums.pairs, 1));
  IcpStep step{.pairs = sums.pairs,
               .rms_residual_m = std::sqrt(sums.residual2_m2 / count),
               .settled = sums.settled};
  if (sums.pairs < 6 || LeavesMotionOpen(sums.A)) return step;
  const Vector6d x = sums.A.ldlt().solve(sums.b);
  // The rotation is about the origin of cur: T <- (x, R(x) about t).
  const Eigen::Matrix3d rotation = RotationFromVector(x.tail<3>());
  step.motion_map = Pose3{
      .rotation = rotation,
      .translation_m = x.head<3>() + T_map_cur.translation_m - rotation * T_map_cur.translation_m};
  return step;
}

double SurfelPairs::Misfit(const Sums& sums) {
  const double freedom = std::max(static_cast<double>(sums.pairs) - 6.0, 1.0);
  return std::max(sums.weighted_residual2 / freedom, 1.0);
}

}  // namespace slam6d
