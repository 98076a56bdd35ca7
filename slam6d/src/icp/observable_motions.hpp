// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "slam6d/geometry/pose3.hpp"
#include "slam6d/src/algebra/decompositions.hpp"

namespace slam6d {

/// What neighbouring surfels of the current scan say together: their errors are not independent of
/// each other, as they lie on the same few things.
struct ClusterEquations {
  Matrix6d A = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();  ///< Without what the errors of the normals add on average.
};

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
  /// @param scatter covariance of the gradient, from the residuals.
  /// @param clusters whose scatter that is. Noise tells more by chance of a motion that few of them
  /// tell of.
  /// @param usual_observations What scatters is known only as well as it is observed often: to the
  /// clusters that tell of a motion come so many that scatter as all motions do on average over
  /// what their weights promise (the mean of an inverse gamma distribution).
  ObservableMotions(const Matrix6d& A,
                    const Matrix6d& A_noise,
                    const Matrix6d& scatter,
                    std::span<const ClusterEquations> clusters,
                    double usual_observations);

  /// What the pairs tell of the motions: A S^-1 A with S the scatter of the gradient (the sandwich
  /// of Huber 1967), without noise, and without the motions that are not observable. It is A where
  /// the residuals are as large as their weights promise, and less where they are larger.
  Matrix6d Information() const;
  /// The gradient that belongs to this information.
  Vector6d Weigh(const Vector6d& b) const;

 private:
  GeneralizedEigen6 eigen_;  ///< A v = share A_noise v.
  Matrix6d weighted_;        ///< A S^-1 in coordinates along those v.
  Matrix6d to_gradient_;     ///< From these coordinates.
  Vector6d told_;            ///< Shares of the observable motions, less noise.
};

}  // namespace slam6d
