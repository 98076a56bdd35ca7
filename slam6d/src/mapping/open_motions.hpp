// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "slam6d/icp/icp.hpp"

namespace slam6d {

/// The motions that the pairs of a registration leave to the guess, and what the guess's error
/// along these does to all the others.
class OpenMotions {
 public:
  /// @param result with a covariance, which must outlive this, as guess and options must.
  OpenMotions(const IcpResult& result,
              const UncertainPose3& T_map_guess,
              const IcpOptions& options);

  /// Whether the pairs tell of every motion at least as much as the guess does.
  bool empty() const { return first_ == kMotions; }
  int size() const { return kMotions - first_; }

  /// The covariance of the result with all that follows from the guess. Sliding along a street, a
  /// scan rises with the ground, turns with it, and meets other surfaces; the equations at one
  /// pose know nothing of these. So the scan is registered again from guesses that are off to both
  /// sides along each open motion, and where it ends beside that motion counts, as in an
  /// unscented transform. Along the motion itself nothing is gained: pairs that hold a
  /// scan wherever it is put do not hold it. Costs two registrations per open motion.
  Matrix6d Covariance(std::span<const IcpReference> references, const ScanModel& cur) const;

 private:
  static constexpr int kMotions = 6;

  const IcpResult& result_;
  const UncertainPose3& T_map_guess_;
  const IcpOptions& options_;
  Vector6d shares_;       ///< Of the guess's variance that is left along each motion, rising.
  Matrix6d motions_;      ///< One standard deviation of the guess each, as columns.
  Matrix6d coordinates_;  ///< A motion x goes x . column k along motion k.
  int first_ = kMotions;  ///< This motion and the later ones are open.
};

}  // namespace slam6d
