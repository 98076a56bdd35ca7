// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/algebra/svd.hpp"

#include <Eigen/SVD>

namespace slam6d {

Svd3 SvdOf(const Eigen::Matrix3d& A) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {.U = svd.matrixU(), .values = svd.singularValues(), .V = svd.matrixV()};
}

}  // namespace slam6d
