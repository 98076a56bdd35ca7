// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/icp/surfel_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam6d/src/algebra/decompositions.hpp"
#include "slam6d/src/parallel.hpp"

namespace slam6d {
namespace {

constexpr std::size_t kSurfelsPerChunk = 512;

/// So many surfels next to each other in the tree count as one observation when it is asked how far
/// the observations scatter.
constexpr std::size_t kSurfelsPerCluster = 16;

/// Surfels whose normals differ more than this (20 degrees) are different surfaces: those that lie
/// across the foot of a tree or the edge of a step hold a scan where nothing holds it. As normals
/// point towards the scanner, so are the two sides of a wall.
constexpr double kMinNormalCosine = 0.94;

/// Sine of the angle (3 degrees) below which a surfel may be seen from either side: its normal is
/// no better known.
constexpr double kGrazingSine = 0.05;

/// The scale of the residuals starts at this share of the maximum distance and shrinks by the
/// factor per iteration: true pairs look like outliers while the guess is poor.
constexpr double kFirstScaleShare = 0.5;
constexpr double kScaleShrink = 0.6;

/// The scale ends no lower than so many times the deviation of most residuals: among trees surfels
/// agree to centimetres only, and a narrower scale holds on to the few that agree by chance (car,
/// see docs/slam6d.md: 63 cm off with a scale of 2 cm, 3.0 cm with this).
constexpr double kScaleDeviations = 4.0;

/// Standard deviation of a normal distribution over the median of its absolute values.
constexpr double kDeviationPerMedian = 1.4826;

/// This share of the squared scale joins the variance of each pair: while the scale is wide,
/// surfels count alike; in the end each counts by its own scatter.
constexpr double kScaleShare = 0.04;

/// Normals better known than this do not exist: keeps their noise regular.
constexpr double kLeastNormalVariance = 1e-8;

/// A motion that two trees hold is not known to millimetres because these agree: when it is asked
/// how well it is known, so many observations that scatter as usual join those that there are. Yet
/// the pose may hang on few things and be right: where they say it is, it is sought.
constexpr double kUsualObservations = 2.0;
constexpr double kNoUsualObservations = 0.0;

constexpr double kUnpaired = std::numeric_limits<double>::quiet_NaN();

/// The covariance of the gradient b, from how far the clusters scatter about the common pose: each
/// is held against the pose that all others find (the jackknife), so that a motion that hangs on
/// one cluster alone counts as not known.
Matrix6d ScatterOf(const NormalEquations& sums, const Matrix6d& prior) {
  const Matrix6d A = sums.A + prior;
  Matrix6d scatter = Matrix6d::Zero();
  for (const ClusterEquations& cluster : sums.clusters) {
    if (cluster.b.isZero(0.0)) continue;
    const Vector6d g = A * SolvePositive(A - cluster.A, cluster.b);
    scatter.noalias() += g * g.transpose();
  }
  return scatter;
}

PointCloud MeansOf(const SurfelMap& map) {
  PointCloud means;
  means.reserve(map.surfels.size());
  for (const Surfel& surfel : map.surfels) means.push_back(surfel.mean_m);
  return means;
}

/// The standard deviation of most of the residuals, without the outliers among them.
double MostDeviateBy(std::span<const double> residuals_of_points_m) {
  std::vector<double> residuals_m;
  residuals_m.reserve(residuals_of_points_m.size());
  for (const double residual_m : residuals_of_points_m) {
    if (!std::isnan(residual_m)) residuals_m.push_back(std::abs(residual_m));
  }
  if (residuals_m.empty()) return 0.0;
  const auto middle = residuals_m.begin() + static_cast<std::ptrdiff_t>(residuals_m.size() / 2);
  std::nth_element(residuals_m.begin(), middle, residuals_m.end());
  return kDeviationPerMedian * *middle;
}

/// Whether the current scanner sees the back of what the reference's own scanner saw, where points
/// have no normals that tell: of a wall thinner than the maximum distance the two sides would
/// otherwise be paired.
bool IsBackOf(const Surfel& ref, const Eigen::Vector3d& scanner_ref_m) {
  const auto sine_of_sight = [&](const Eigen::Vector3d& eye_m) {
    const Eigen::Vector3d sight_m = eye_m - ref.mean_m;
    return ref.normal.dot(sight_m) / sight_m.norm();
  };
  return sine_of_sight(scanner_ref_m) < -kGrazingSine &&
         sine_of_sight(Eigen::Vector3d::Zero()) > kGrazingSine;
}

/// sum += a b^T, a column at a time: Eigen's own product is not unrolled.
void AddOuter(const Vector6d& a, const Vector6d& b, Matrix6d& sum) {
  for (int column = 0; column < 6; ++column) sum.col(column) += b(column) * a;
}

/// C along the axes of another frame.
Eigen::Matrix3d TurnedSpread(const Eigen::Matrix3d& R, const Eigen::Matrix3d& C) {
  return R.lazyProduct(C.lazyProduct(R.transpose()).eval());
}

/// What the error of the normal, of covariance C, adds on average. The row of a pair is
/// J = (I; [arm]x) n: products with the unit matrix are left out.
void AddNoise(double weight,
              const Eigen::Vector3d& arm_m,
              const Eigen::Matrix3d& C,
              const Eigen::Vector3d& offset_m,
              NormalEquations& equations) {
  const Eigen::Matrix3d weighted_C =
      weight * (C + kLeastNormalVariance * Eigen::Matrix3d::Identity());
  Eigen::Matrix3d arm_C;
  for (int i = 0; i < 3; ++i) arm_C.col(i) = arm_m.cross(weighted_C.col(i));
  Eigen::Matrix3d arm_C_arm;
  for (int i = 0; i < 3; ++i) arm_C_arm.col(i) = arm_m.cross(arm_C.row(i).transpose());
  equations.A_noise.topLeftCorner<3, 3>() += weighted_C;
  equations.A_noise.bottomLeftCorner<3, 3>() += arm_C;
  equations.A_noise.bottomRightCorner<3, 3>() += arm_C_arm;
  const Eigen::Vector3d pull = weighted_C * offset_m;
  equations.b_noise.head<3>() += pull;
  equations.b_noise.tail<3>() += arm_m.cross(pull);
}

}  // namespace

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  A += other.A;
  hessian += other.hessian;
  b += other.b;
  A_noise += other.A_noise;
  b_noise += other.b_noise;
  weighted_residual2 += other.weighted_residual2;
  residual2_m2 += other.residual2_m2;
  pairs += other.pairs;
  if (clusters.empty()) clusters.resize(other.clusters.size());
  for (std::size_t i = 0; i < other.clusters.size(); ++i) {
    clusters[i].A += other.clusters[i].A;
    clusters[i].b += other.clusters[i].b;
  }
  settled = settled && other.settled;
  return *this;
}

NormalEquations NormalEquations::In(const Pose3& T_map_ref) const {
  const Matrix6d R = BlockRotation(T_map_ref.rotation);
  NormalEquations moved = *this;
  moved.A = R * A * R.transpose();
  moved.hessian = R * hessian * R.transpose();
  moved.b = R * b;
  moved.A_noise = R * A_noise * R.transpose();
  moved.b_noise = R * b_noise;
  for (ClusterEquations& cluster : moved.clusters) {
    cluster.A = R * cluster.A * R.transpose();
    cluster.b = R * cluster.b;
  }
  return moved;
}

SurfelPairs::SurfelPairs(const ScanModel& ref, const ScanModel& cur, const IcpOptions& options)
    : ref_(ref.surfels),
      cur_surfels_(options.metric == IcpMetric::kPlaneToPlane ? &cur.surfels : nullptr),
      options_(options),
      cur_(cur_surfels_ != nullptr ? MeansOf(*cur_surfels_) : cur.points),
      search_(ref.tree, cur_, {.max_distance_m = options.max_distance_m, .start = options.search}),
      residuals_m_(cur_.size(), kUnpaired),
      scale_m_(kFirstScaleShare * options.max_distance_m) {}

void SurfelPairs::AddPair(const Rules& rules, std::size_t i, NormalEquations& equations) {
  residuals_m_[i] = kUnpaired;
  if (!search_.found(i)) return;
  const std::int32_t number = ref_.surfel_of_block[search_.neighbor_slot(i) / kLanes];
  if (number == SurfelMap::kNone) return;
  const Surfel& ref = ref_.surfels[static_cast<std::size_t>(number)];
  Eigen::Vector3d normal = ref.normal;
  Eigen::Matrix3d C = ref.normal_covariance;
  double variance_m2 = ref.variance_m2 + options_.surface_noise_m * options_.surface_noise_m;
  if (cur_surfels_ != nullptr) {
    const Surfel& cur = cur_surfels_->surfels[i];
    const Eigen::Vector3d normal_ref = rules.T_ref_cur.rotation * cur.normal;
    const double cosine = ref.normal.dot(normal_ref);
    if (cosine < kMinNormalCosine) return;
    normal = (ref.normal + normal_ref).normalized();
    variance_m2 += cur.variance_m2;
    const Eigen::Matrix3d& R = rules.T_ref_cur.rotation;
    C = 0.25 * (C + TurnedSpread(R, cur.normal_covariance));  // Of the mean of both.
  } else if (IsBackOf(ref, rules.T_ref_cur.translation_m)) {
    return;
  }
  const Eigen::Vector3d point_m = search_.query_m(i);
  const Eigen::Vector3d offset_m = ref.mean_m - point_m;
  const double residual_m = normal.dot(offset_m);
  residuals_m_[i] = residual_m;
  variance_m2 += offset_m.dot(C * offset_m) + kScaleShare * rules.scale2_m2;
  // Geman & McClure (1987): weight (1 + r^2 / s^2)^-2.
  const double outlier = 1.0 + residual_m * residual_m / rules.scale2_m2;
  const double weight = 1.0 / (variance_m2 * outlier * outlier);
  const double slope = (4.0 - 3.0 * outlier) / outlier;  // d(weight r)/dr over the weight.
  const Eigen::Vector3d arm_m = point_m - rules.T_ref_cur.translation_m;
  Vector6d J;
  J << normal, arm_m.cross(normal);
  const Vector6d weighted_J = weight * J;
  AddOuter(weighted_J, J, equations.A);
  AddOuter(slope * weighted_J, J, equations.hessian);
  equations.b += residual_m * weighted_J;
  AddNoise(weight, arm_m, C, offset_m, equations);
  equations.weighted_residual2 += weight * residual_m * residual_m;
  equations.residual2_m2 += residual_m * residual_m;
  ++equations.pairs;
}

NormalEquations SurfelPairs::Sum(const Rules& rules, std::size_t first, std::size_t last) {
  NormalEquations equations;
  for (std::size_t i = first; i < last; ++i) AddPair(rules, i, equations);
  Matrix6d& noise = equations.A_noise;
  noise.topRightCorner<3, 3>() = noise.bottomLeftCorner<3, 3>().transpose();
  return equations;
}

/// The sums of a chunk, and of each of its clusters.
NormalEquations SurfelPairs::SumClusters(const Rules& rules, std::size_t first, std::size_t last) {
  NormalEquations total;
  std::vector<ClusterEquations> clusters;
  for (std::size_t begin = first; begin < last; begin += kSurfelsPerCluster) {
    const NormalEquations sum = Sum(rules, begin, std::min(last, begin + kSurfelsPerCluster));
    total += sum;
    clusters.push_back({.A = sum.A, .b = sum.b - sum.b_noise});
  }
  total.clusters = std::move(clusters);
  return total;
}

/// @return whether the scale has changed.
bool SurfelPairs::ShrinkScale() {
  const double before_m = scale_m_;
  const double least_m =
      std::max(options_.residual_scale_m, kScaleDeviations * MostDeviateBy(residuals_m_));
  scale_m_ = std::min(before_m, std::max(least_m, kScaleShrink * before_m));
  return scale_m_ < before_m;
}

NormalEquations SurfelPairs::Collect(const Pose3& T_ref_cur, int iteration) {
  const bool settled = iteration > 1 && !ShrinkScale();
  const Rules rules{.T_ref_cur = T_ref_cur, .scale2_m2 = scale_m_ * scale_m_};
  search_.MoveTo(T_ref_cur);
  const std::size_t chunks = (cur_.size() + kSurfelsPerChunk - 1) / kSurfelsPerChunk;
  std::vector<NormalEquations> sums(chunks);
  std::vector<SearchStatistics> statistics(chunks);
  const auto work = [&](std::size_t chunk, std::size_t first, std::size_t last) {
    statistics[chunk] = search_.Find(first, last);
    sums[chunk] = SumClusters(rules, first, last);
  };
  ForChunks(cur_.size(), kSurfelsPerChunk, options_.threads, work);
  for (const SearchStatistics& part : statistics) statistics_ += part;
  NormalEquations total;
  std::vector<ClusterEquations> clusters;
  for (NormalEquations& part : sums) {
    clusters.insert(clusters.end(), part.clusters.begin(), part.clusters.end());
    part.clusters.clear();
    total += part;
  }
  total.clusters = std::move(clusters);
  total.settled = settled;
  curvature_ = total.hessian;
  weight_ = total.A;
  return total;
}

IcpStep SurfelPairs::Step(const Sums& sums, const PoseAndGuess& T_map, const IcpOptions&) {
  const double count = static_cast<double>(std::max<std::size_t>(sums.pairs, 1));
  IcpStep step{.pairs = sums.pairs,
               .rms_residual_m = std::sqrt(sums.residual2_m2 / count),
               .settled = sums.settled};
  if (sums.pairs < 6 || LeavesMotionOpen(sums.A)) return step;
  const Vector6d to_guess = Difference(T_map.guess.T_a_b, T_map.now);
  const Matrix6d prior = ToldByGuess(T_map.guess);
  const ObservableMotions observable(
      sums.A, sums.A_noise, ScatterOf(sums, prior), sums.clusters, kNoUsualObservations);
  const Matrix6d information = observable.Information() + prior;
  const Vector6d x =
      SolvePositive(information, observable.Weigh(sums.b - sums.b_noise) + prior * to_guess);
  step.motion_chi2 = x.dot(information * x);
  // The rotation is about the origin of cur: T <- (x, R(x) about t).
  const Eigen::Matrix3d rotation = RotationFromVector(x.tail<3>());
  const Eigen::Vector3d& center_m = T_map.now.translation_m;
  step.motion_map =
      Pose3{.rotation = rotation, .translation_m = x.head<3>() + center_m - rotation * center_m};
  return step;
}

Matrix6d SurfelPairs::Told(const Sums& sums,
                           const Matrix6d& curvature,
                           const UncertainPose3& guess) {
  const Matrix6d scatter = ScatterOf(sums, ToldByGuess(guess));
  return ObservableMotions(curvature, sums.A_noise, scatter, sums.clusters, kUsualObservations)
      .Information();
}

Matrix6d SurfelPairs::ToldByGuess(const UncertainPose3& guess) {
  return InverseOf(guess.covariance);
}

}  // namespace slam6d
