// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/messages/transform3.hpp"

#include <cmath>

#include "qwsm/geometry/position.hpp"

namespace qwsm::io {
namespace {

Quaternion Conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

double SquaredLength(const Quaternion& q) { return q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w; }

}  // namespace

bool IsSound(const Transform3& t) {
  const double squared_length = SquaredLength(t.rotation);
  return IsCoordinate(t.x_m) && IsCoordinate(t.y_m) && IsCoordinate(t.z_m) &&
         std::abs(squared_length - 1.0) < 0.1;
}

Transform3 operator*(const Transform3& T_a_b, const Transform3& T_b_c) {
  const Quaternion& q = T_a_b.rotation;
  const Quaternion p{T_b_c.x_m, T_b_c.y_m, T_b_c.z_m, 0.0};
  const Quaternion turned = q * p * Conjugate(q);
  const double scale = 1.0 / SquaredLength(q);
  return {.x_m = T_a_b.x_m + scale * turned.x,
          .y_m = T_a_b.y_m + scale * turned.y,
          .z_m = T_a_b.z_m + scale * turned.z,
          .rotation = q * T_b_c.rotation};
}

Transform3 Transform3::Inverse() const {
  const Transform3 turned = Transform3{.rotation = Conjugate(rotation)} *
                            Transform3{.x_m = -x_m, .y_m = -y_m, .z_m = -z_m, .rotation = {}};
  return turned;
}

}  // namespace qwsm::io
