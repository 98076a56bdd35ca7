// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/src/icp/icp_step.hpp"

namespace slam6d {

/// The normal equations of one Gauss-Newton step over (x, y, z, roll, pitch, yaw).
struct NormalEquations {
  Matrix6d A = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double weighted_residual2 = 0.0;  ///< Squared residuals over their variances.
  double residual2_m2 = 0.0;
  std::size_t pairs = 0;

  NormalEquations& operator+=(const NormalEquations& other);
};

/// Point to plane and plane to plane: Gauss-Newton on distances along surface normals.
class SurfelMinimizer final : public IcpMinimizer {
 public:
  /// Both must outlive the minimizer.
  SurfelMinimizer(const ScanModel& ref, const ScanModel& cur, const IcpOptions& options);

  IcpStep Iterate(const Pose3& T_ref_cur, int iteration) override;
  Matrix6d Covariance(const Pose3& T_ref_cur) const override;
  const SearchStatistics& statistics() const override { return statistics_; }

 private:
  /// Weights and normals of an iteration.
  struct Rules {
    Pose3 T_ref_cur;
    double scale2_m2;  ///< Residuals well above it lose their weight.
  };

  NormalEquations Sum(const Rules& rules, std::size_t first, std::size_t last) const;
  void AddPair(const Rules& rules, std::size_t i, NormalEquations& equations) const;

  const SurfelMap& ref_;
  const SurfelMap* cur_surfels_;  ///< None for points.
  const IcpOptions options_;
  PointCloud cur_;
  CachedSearch search_;
  PointCloud cur_ref_;
  NormalEquations last_;
  SearchStatistics statistics_;
};

}  // namespace slam6d
