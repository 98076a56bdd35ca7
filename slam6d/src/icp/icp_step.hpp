// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "slam6d/icp/icp.hpp"

namespace slam6d {

/// What one iteration found out.
struct IcpStep {
  std::size_t pairs = 0;
  double rms_residual_m = 0.0;
  /// The motion, in the frame ref, by which the current scan is to move; nothing when the pairs
  /// leave it open.
  std::optional<Pose3> motion_ref{};
  bool settled = true;  ///< False while the weights still change by themselves.
};

/// Pairs, and the step they ask for, under one metric. Each object serves one registration.
class IcpMinimizer {
 public:
  IcpMinimizer() = default;
  IcpMinimizer(const IcpMinimizer&) = delete;
  IcpMinimizer& operator=(const IcpMinimizer&) = delete;
  virtual ~IcpMinimizer() = default;

  virtual IcpStep Iterate(const Pose3& T_ref_cur, int iteration) = 0;
  /// Of the pose, from the pairs of the last iteration.
  virtual Matrix6d Covariance(const Pose3& T_ref_cur) const = 0;
  virtual const SearchStatistics& statistics() const = 0;
};

}  // namespace slam6d
