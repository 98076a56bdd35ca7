// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/icp/observable_motions.hpp"

#include <algorithm>
#include <cmath>

namespace slam6d {
namespace {

/// Below this share of the largest eigenvalue the surfaces leave a motion open.
constexpr double kOpenShare = 1e-9;

/// A motion is observable where the pairs tell so many times as much of it as the errors of the
/// normals would by themselves.
constexpr double kObservableShare = 3.0;

}  // namespace

bool LeavesMotionOpen(const Matrix6d& A) {
  // Rotations are compared with translations at an arm of the size of the scene.
  const double arm_m = std::sqrt(A.bottomRightCorner<3, 3>().trace() /
                                 std::max(A.topLeftCorner<3, 3>().trace(), 1e-300));
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1.0 / std::max(arm_m, 1e-300));
  const Matrix6d scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Vector6d eigenvalues = EigenvaluesOf(scaled);
  return !(eigenvalues(0) > kOpenShare * eigenvalues(5));
}

ObservableMotions::ObservableMotions(const Matrix6d& A, const Matrix6d& A_noise)
    : eigen_(GeneralizedEigenOf(A, A_noise)),
      to_gradient_(A_noise * eigen_.vectors),
      is_observable_(eigen_.values.array() > kObservableShare) {}

Matrix6d ObservableMotions::Information() const {
  const Vector6d told = is_observable_.select(eigen_.values.array() - 1.0, 0.0);
  return to_gradient_ * told.asDiagonal() * to_gradient_.transpose();
}

Vector6d ObservableMotions::Project(const Vector6d& b) const {
  const Vector6d along = eigen_.vectors.transpose() * b;
  return to_gradient_ * is_observable_.select(along.array(), 0.0).matrix();
}

}  // namespace slam6d
