// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/geometry/quaternion.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

#include "qwsm/geometry/angle.hpp"

namespace qwsm {
namespace {

double NeighborOf(double value, int steps) {
  const double towards = std::copysign(std::numeric_limits<double>::infinity(), steps);
  for (int i = 0; i < std::abs(steps); ++i) value = std::nextafter(value, towards);
  return value;
}

}  // namespace

Quaternion QuaternionOf(double theta_rad) {
  const Quaternion rounded{0.0, 0.0, std::sin(theta_rad / 2.0), std::cos(theta_rad / 2.0)};
  // Sine and cosine are rounded; among their neighbours is a pair that gives the angle back.
  constexpr int kReach = 3;
  for (int dz = 0; dz <= kReach; ++dz) {
    for (int dw = 0; dw <= kReach; ++dw) {
      for (const int sign : {1, -1}) {
        for (const int side : {1, -1}) {
          const Quaternion near{
              0.0, 0.0, NeighborOf(rounded.z, sign * dz), NeighborOf(rounded.w, side * dw)};
          if (YawOf(near) == theta_rad) return near;
        }
      }
    }
  }
  return rounded;
}

double YawOf(const Quaternion& q) {
  if (q.x == 0.0 && q.y == 0.0) return NormalizeAngle(2.0 * std::atan2(q.z, q.w));
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

double UprightnessOf(const Quaternion& q) {
  const double squared_length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return (q.w * q.w + q.z * q.z - q.x * q.x - q.y * q.y) / squared_length;
}

Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {.x = a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          .y = a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          .z = a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
          .w = a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

}  // namespace qwsm
