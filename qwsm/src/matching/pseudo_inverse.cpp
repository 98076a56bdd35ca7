// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pseudo_inverse.hpp"

#include <Eigen/QR>

namespace qwsm {

Eigen::Matrix3d PseudoInverse(const Eigen::Matrix3d& A) {
  return A.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace qwsm
