// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace qwsm {

/// Standard deviations of one reading. The range bias is taken as 0, as in Visser et al. (2009).
struct RangeNoise {
  double range_sigma_m = 0.01;
  double bearing_sigma_rad = 0.002;
};

template <class Visitor>
void Describe(Visitor& visit, RangeNoise& o) {
  visit("range_sigma_m",
        o.range_sigma_m,
        {.help = "standard deviation of a range reading", .min = 1e-4, .max = 1});
  visit("bearing_sigma_rad",
        o.bearing_sigma_rad,
        {.help = "standard deviation of a beam's direction", .min = 1e-5, .max = 0.2});
}

/// Covariance of the measurement noise of a point, in m^2, in the frame of `beam`: that of the
/// delta c in Visser et al. (2009), Eq. (2), whose bias b is taken as 0 as there.
///
/// Pfister et al. (2002), noise of one beam: N = s_r^2 e e^T + (r s_b)^2 f f^T.
/// @param beam unit vector from the laser to the point, e; f is perpendicular to it.
inline Eigen::Matrix2d PointCovariance(const Eigen::Vector2d& beam,
                                       double range_m,
                                       const RangeNoise& noise) {
  const Eigen::Vector2d across(-beam.y(), beam.x());
  const double along_m2 = noise.range_sigma_m * noise.range_sigma_m;
  const double across_m = range_m * noise.bearing_sigma_rad;
  return along_m2 * beam * beam.transpose() + across_m * across_m * across * across.transpose();
}

/// Variance of the measurement noise of a point along a direction, n^T N n, in m^2.
/// @param direction unit vector n.
inline double NoiseAlong(const Eigen::Vector2d& direction,
                         const Eigen::Vector2d& beam,
                         double range_m,
                         const RangeNoise& noise) {
  const double sine = beam.x() * direction.y() - beam.y() * direction.x();
  const double along_m = noise.range_sigma_m * beam.dot(direction);
  const double across_m = range_m * noise.bearing_sigma_rad * sine;
  return along_m * along_m + across_m * across_m;
}

}  // namespace qwsm
