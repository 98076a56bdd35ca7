// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/src/icp/icp_step.hpp"

namespace slam6d {

/// Point to point: nearest points, closed form (paper Eqs. 2-6).
class PointMinimizer final : public IcpMinimizer {
 public:
  /// Both must outlive the minimizer.
  PointMinimizer(const KdTree& ref, const PointCloud& cur, const IcpOptions& options);

  IcpStep Iterate(const Pose3& T_ref_cur, int iteration) override;
  Matrix6d Covariance(const Pose3& T_ref_cur) const override;
  const SearchStatistics& statistics() const override { return statistics_; }

 private:
  const PointCloud& cur_;
  const IcpOptions options_;
  CachedSearch search_;
  SimdLevel simd_;
  PointCloud cur_ref_;  ///< The current points in the frame ref.
  Eigen::Vector3d origin_m_;
  double counted_distance2_m2_;  ///< Pairs as far apart as this do not count.
  double rms_residual_m_ = 0.0;
  SearchStatistics statistics_;
};

}  // namespace slam6d
