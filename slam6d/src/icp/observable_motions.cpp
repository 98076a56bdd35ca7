// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/icp/observable_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slam6d {
namespace {

/// Below this share of the largest eigenvalue the surfaces leave a motion open.
constexpr double kOpenShare = 1e-9;

/// A motion is observable where the pairs tell so many times as much of it as the errors of the
/// normals would by themselves, or more where these may tell more by chance.
constexpr double kObservableShare = 3.0;

/// So many deviations of a normal distribution only one in a thousand exceeds.
constexpr double kSurelyDeviations = 3.09;

/// The residuals of a few pairs may agree by chance: no less of the scatter that their weights
/// promise is taken for granted.
constexpr double kLeastScatter = 0.25;

/// How many clusters tell of a motion, as if they all told the same of it.
double ObservationsOf(std::span<const ClusterEquations> clusters, const Vector6d& motion) {
  double sum = 0.0;
  double sum2 = 0.0;
  for (const ClusterEquations& cluster : clusters) {
    const double told = motion.dot(cluster.A * motion);
    sum += told;
    sum2 += told * told;
  }
  return sum2 > 0.0 ? sum * sum / sum2 : std::numeric_limits<double>::infinity();
}

/// Noise of so many observations surely tells of a motion no more than this multiple of what it
/// tells on average: chi2 over its degrees of freedom (Wilson & Hilferty 1931).
double MostByNoise(double observations) {
  const double variance = 2.0 / (9.0 * observations);
  return std::pow(1.0 - variance + kSurelyDeviations * std::sqrt(variance), 3);
}

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

ObservableMotions::ObservableMotions(const Matrix6d& A,
                                     const Matrix6d& A_noise,
                                     const Matrix6d& scatter,
                                     std::span<const ClusterEquations> clusters,
                                     double usual_observations)
    : eigen_(GeneralizedEigenOf(A, A_noise)), to_gradient_(A_noise * eigen_.vectors) {
  Vector6d observations;
  Eigen::Array<bool, 6, 1> is_observable;
  for (int k = 0; k < 6; ++k) {
    observations(k) = ObservationsOf(clusters, eigen_.vectors.col(k));
    is_observable(k) = eigen_.values(k) > std::max(kObservableShare, MostByNoise(observations(k)));
  }
  told_ = is_observable.select(eigen_.values.array() - 1.0, 0.0);
  Matrix6d S = eigen_.vectors.transpose() * scatter * eigen_.vectors;
  const Vector6d ratios = S.diagonal().cwiseQuotient(eigen_.values);
  const double usual_ratio = is_observable.select(ratios.array(), 0.0).sum() /
                             std::max(1.0, static_cast<double>(is_observable.count()));
  for (int k = 0; k < 6; ++k) {
    const double drawn = usual_observations / observations(k);
    S(k, k) += (kLeastScatter + drawn * usual_ratio) * eigen_.values(k);
    if (is_observable(k)) continue;
    S.row(k).setZero();
    S.col(k).setZero();
    S(k, k) = 1.0;
  }
  weighted_ = told_.asDiagonal() * InverseOf(S);
}

Matrix6d ObservableMotions::Information() const {
  return to_gradient_ * (weighted_ * told_.asDiagonal()) * to_gradient_.transpose();
}

Vector6d ObservableMotions::Weigh(const Vector6d& b) const {
  return to_gradient_ * (weighted_ * (eigen_.vectors.transpose() * b));
}

}  // namespace slam6d
