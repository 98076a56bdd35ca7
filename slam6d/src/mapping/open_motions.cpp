// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/mapping/open_motions.hpp"

#include <optional>

#include "slam6d/src/algebra/decompositions.hpp"

namespace slam6d {
namespace {

/// Of the variance that the guess has, the pairs leave no more where they tell as much as it does.
constexpr double kLeastHeldShare = 0.5;

/// Guesses are put so many standard deviations off; weighted by a sixth each they have the moments
/// of a normal distribution up to the fifth (Gauss and Hermite's rule of three points).
constexpr double kDeviations = 1.7320508075688772;
constexpr double kWeight = 1.0 / 6.0;

/// The pose moved along the axes of its parent frame, and turned about its own origin.
Pose3 Displaced(const Pose3& pose, const Vector6d& motion) {
  return {.rotation = RotationFromVector(motion.tail<3>()) * pose.rotation,
          .translation_m = pose.translation_m + motion.head<3>()};
}

}  // namespace

OpenMotions::OpenMotions(const IcpResult& result,
                         const UncertainPose3& T_map_guess,
                         const IcpOptions& options)
    : result_(result), T_map_guess_(T_map_guess), options_(options) {
  const Matrix6d& before = T_map_guess.covariance;
  const GeneralizedEigen6 eigen = GeneralizedEigenOf(result.covariance, before);
  shares_ = eigen.values;
  motions_ = before * eigen.vectors;
  coordinates_ = eigen.vectors;
  while (first_ > 0 && shares_(first_ - 1) > kLeastHeldShare) --first_;
}

Matrix6d OpenMotions::Covariance(std::span<const IcpReference> references,
                                 const ScanModel& cur) const {
  Matrix6d covariance = result_.covariance;
  for (int k = first_; k < kMotions; ++k) {
    const Vector6d along = shares_(k) * motions_.col(k);  // Where all is linear.
    Matrix6d spread = Matrix6d::Zero();
    for (const double deviations : {kDeviations, -kDeviations}) {
      UncertainPose3 guess = T_map_guess_;
      guess.T_a_b = Displaced(guess.T_a_b, deviations * motions_.col(k));
      const PoseAndGuess start{.now = Displaced(result_.T_ref_cur, deviations * along),
                               .guess = guess};
      const IcpResult end = Align(references, cur, start, options_);
      Vector6d moved = deviations * along;
      if (end.covariance.trace() > 0.0) {
        const Vector6d all = Difference(end.T_ref_cur, result_.T_ref_cur);
        moved += all - coordinates_.col(k).dot(all) * motions_.col(k);
      }
      spread += kWeight * moved * moved.transpose();
    }
    covariance += spread - along * along.transpose();
  }
  return covariance;
}

}  // namespace slam6d
