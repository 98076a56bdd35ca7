// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// How the error of a scan's pose follows from those of scans before it. A scan that was registered
/// with three others is where these say on average: it has the weighted mean of their errors, and
/// one of its own.
struct ErrorOrigin {
  struct Share {
    std::size_t of = 0;                      ///< A scan before.
    Matrix6d weight = Matrix6d::Identity();  ///< All of a scan's weights add up to one.
  };

  std::size_t scan = 0;
  std::vector<Share> shares;
  /// Of the error of its own, as in UncertainPose3; this and the weights along the scan's own axes.
  Matrix6d covariance = Matrix6d::Identity();
};

/// How uncertain the poses of some scans are, and together: poses that hang on the same scans share
/// their errors.
struct JointCovariance {
  std::vector<std::size_t> scans;
  /// Of all their poses as in UncertainPose3, six rows a scan; scan 0 is not uncertain and has
  /// none.
  Eigen::MatrixXd covariance;

  /// Covariance of the pose of one of the scans, or of scan 0.
  Matrix6d Of(std::size_t scan) const;
};

/// How uncertain scans are by all that is known of where their errors come from. A scan may have
/// several origins, as where it closes a loop: then it is known as well as all of them together
/// tell, and others are better known by that. O(origins), as their graph is long and narrow.
/// @pre every scan but scan 0 has an origin.
JointCovariance CovarianceBy(std::span<const ErrorOrigin> origins,
                             std::span<const Pose3> T_map_scan,
                             std::vector<std::size_t> scans);

/// The same for the scans of `known` and a new one that has this origin alone, however long the
/// drive is. O(scans of `known` squared).
/// @pre the origin names scans of `known` and scan 0 alone.
JointCovariance WithNext(const JointCovariance& known,
                         const ErrorOrigin& origin,
                         std::span<const Pose3> T_map_scan);

/// What is known of some of the scans.
JointCovariance Kept(const JointCovariance& known, std::vector<std::size_t> scans);

}  // namespace slam6d
