// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "slam6d/geometry/pose3.hpp"
#include "slam6d/src/algebra/decompositions.hpp"

namespace slam6d {

/// Whether surfaces with the normal equations A leave a motion open of which not even noise tells.
bool LeavesMotionOpen(const Matrix6d& A);

/// The motions that are observable by pairs of surfels, and what the pairs tell of these.
///
/// Along a corridor all normals point across it, but for their errors, and these pass for
/// information along it: they draw a scan to where the one before was taken. Their mean share is
/// known and taken out (renormalisation: Kanatani 1996, chapter 9), and what is left of a motion
/// counts only where it is well above that.
class ObservableMotions {
 public:
  /// Compares what pairs tell with noise.
  /// @param A of the normal equations.
  /// @param A_noise what the errors of the normals add to A on average; positive definite.
  ObservableMotions(const Matrix6d& A, const Matrix6d& A_noise);

  /// A without noise, and without the motions that are not observable.
  Matrix6d Information() const;
  /// The part of a gradient, noise taken out, that belongs to observable motions.
  Vector6d Project(const Vector6d& b) const;

 private:
  GeneralizedEigen6 eigen_;  ///< A v = share A_noise v.
  Matrix6d to_gradient_;     ///< From coordinates along those v.
  Eigen::Array<bool, 6, 1> is_observable_;
};

}  // namespace slam6d
