// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/icp/point_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "slam6d/src/algebra/decompositions.hpp"
#include "slam6d/src/parallel.hpp"
#include "slam6d/src/search/kernel_views.hpp"

namespace slam6d {
namespace {

/// Small enough that a chunk's points stay in the cache from one of its three loops to the next.
constexpr std::size_t kPointsPerChunk = 2048;

/// More pairs than so many do not make a pose better known, as their errors are not independent: of
/// a robot tilted on a step, points found the place to 19 cm, and all pairs promised 0.1 mm.
constexpr double kIndependentPairs = 30.0;

/// Scans that are the same to the last bit are known to a micrometre.
constexpr double kLeastVariance_m2 = 1e-12;

/// The middle of the reference: sums are taken about it, against cancellation far from the origin.
Eigen::Vector3d MiddleOf(const KdTree& tree) {
  if (tree.empty()) return Eigen::Vector3d::Zero();
  const Box& limits = tree.layout().limits[0];
  return 0.5 * Eigen::Vector3d(limits.low_m) + 0.5 * Eigen::Vector3d(limits.high_m);
}

/// Moments about the centroids from sums about `origin_m`.
PairMoments MomentsOf(const PairSums& sums, const Eigen::Vector3d& origin_m) {
  const double* value = sums.value;
  PairMoments moments{.count = value[0]};
  if (moments.count == 0.0) return moments;
  const Eigen::Vector3d sum_m = Eigen::Map<const Eigen::Vector3d>(value + 2);
  const Eigen::Vector3d sum_d = Eigen::Map<const Eigen::Vector3d>(value + 5);
  const Eigen::Matrix3d sum_d_m =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(value + 8);
  moments.center_ref_m = origin_m + sum_m / moments.count;
  moments.center_cur_m = origin_m + sum_d / moments.count;
  moments.H_m2 = sum_d_m - sum_d * sum_m.transpose() / moments.count;
  return moments;
}

PairSums SumInOrder(const std::vector<PairSums>& parts) {
  PairSums total{};
  for (const PairSums& part : parts) {
    for (int k = 0; k < PairSums::kCount; ++k) total.value[k] += part.value[k];
  }
  return total;
}

}  // namespace

PointSums PointSums::In(const Pose3& T_map_ref) const {
  const Eigen::Matrix3d& R = T_map_ref.rotation;
  return {.moments = {.count = moments.count,
                      .center_ref_m = T_map_ref * moments.center_ref_m,
                      .center_cur_m = T_map_ref * moments.center_cur_m,
                      .H_m2 = R * moments.H_m2 * R.transpose()},
          .distance2_m2 = distance2_m2};
}

PointSums& PointSums::operator+=(const PointSums& other) {
  if (other.moments.count == 0.0) return *this;
  const PairMoments& a = moments;
  const PairMoments& b = other.moments;
  PairMoments both{.count = a.count + b.count};
  const double share = b.count / both.count;
  const Eigen::Vector3d apart_ref_m = b.center_ref_m - a.center_ref_m;
  const Eigen::Vector3d apart_cur_m = b.center_cur_m - a.center_cur_m;
  both.center_ref_m = a.center_ref_m + share * apart_ref_m;
  both.center_cur_m = a.center_cur_m + share * apart_cur_m;
  // Chan, Golub & LeVeque (1979): moments of two sets from those of each.
  both.H_m2 = a.H_m2 + b.H_m2 + a.count * share * apart_cur_m * apart_ref_m.transpose();
  moments = both;
  distance2_m2 += other.distance2_m2;
  return *this;
}

PointPairs::PointPairs(const ScanModel& ref, const ScanModel& cur, const IcpOptions& options)
    : cur_(cur.points),
      options_(options),
      search_(ref.tree,
              cur.points,
              {.max_distance_m = options.max_distance_m, .start = options.search}),
      simd_(ref.tree.simd()),
      origin_m_(MiddleOf(ref.tree)),
      counted_distance2_m2_(search_.max_distance2_m2()) {}

PointSums PointPairs::Collect(const Pose3& T_ref_cur, int iteration) {
  if (iteration > 1 && options_.max_rms_ratio > 0.0) {
    const double limit_m = options_.max_rms_ratio * rms_residual_m_;
    counted_distance2_m2_ = std::min(search_.max_distance2_m2(), limit_m * limit_m);
  }
  T_ref_cur_ = T_ref_cur;
  search_.MoveTo(T_ref_cur);
  const std::size_t chunks = (cur_.size() + kPointsPerChunk - 1) / kPointsPerChunk;
  std::vector<PairSums> sums(chunks);
  std::vector<SearchStatistics> statistics(chunks);
  const auto work = [&](std::size_t chunk, std::size_t first, std::size_t last) {
    statistics[chunk] = search_.Find(first, last);
    const PairRange pairs{.ref = ViewOf(search_.neighbors()),
                          .cur = ViewOf(cur_),
                          .T_ref_cur = ViewOf(T_ref_cur),
                          .max_distance2_m2 = counted_distance2_m2_,
                          .origin_m = {origin_m_.x(), origin_m_.y(), origin_m_.z()},
                          .first = first,
                          .last = last};
    KernelFor(simd_).sum_pairs(pairs, sums[chunk]);
  };
  ForChunks(cur_.size(), kPointsPerChunk, options_.threads, work);
  for (const SearchStatistics& part : statistics) statistics_ += part;

  const PairSums total = SumInOrder(sums);
  const PointSums result{.moments = MomentsOf(total, origin_m_), .distance2_m2 = total.value[1]};
  rms_residual_m_ = std::sqrt(result.distance2_m2 / std::max(result.moments.count, 1.0));
  return result;
}

IcpStep PointPairs::Step(const Sums& sums, const PoseAndGuess&, const IcpOptions& options) {
  return {
      .pairs = static_cast<std::size_t>(sums.moments.count),
      .rms_residual_m = std::sqrt(sums.distance2_m2 / std::max(sums.moments.count, 1.0)),
      .motion_map = AlignPairs(sums.moments, options.closed_form),
  };
}

Matrix6d PointPairs::Curvature() const {
  // Residual m - (R d + t), small rotations about the origin of cur: J = [I | -[R d]x].
  Matrix6d curvature = Matrix6d::Zero();
  for (std::size_t i = 0; i < cur_.size(); ++i) {
    if (!(search_.distance2_m2(i) < counted_distance2_m2_)) continue;
    Eigen::Matrix<double, 3, 6> J;
    J << Eigen::Matrix3d::Identity(), -Skew(search_.query_m(i) - T_ref_cur_.translation_m);
    curvature.noalias() += J.transpose() * J;
  }
  return curvature;
}

Matrix6d PointPairs::Told(const Sums& sums, const Matrix6d& curvature, const UncertainPose3&) {
  const double count = std::max(sums.moments.count, 1.0);
  const double variance_m2 = std::max(sums.distance2_m2 / count / 3.0, kLeastVariance_m2);
  // Nearest points are other samples of the surface: their distances are no independent errors,
  // but lead astray together.
  const double independent = std::min(count, kIndependentPairs);
  return independent / (count * variance_m2) * curvature;
}

}  // namespace slam6d
