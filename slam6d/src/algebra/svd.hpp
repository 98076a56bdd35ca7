// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace slam6d {

/// The singular value decomposition A = U diag(values) V^T.
struct Svd3 {
  Eigen::Matrix3d U;
  Eigen::Vector3d values;  ///< Not negative, falling.
  Eigen::Matrix3d V;
};
Svd3 SvdOf(const Eigen::Matrix3d& A);

}  // namespace slam6d
