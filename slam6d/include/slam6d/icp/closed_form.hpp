// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// What the closed forms need to know of pairs (m_i, d_i): their number, centroids (Nüchter et
/// al. 2007, Eq. 3) and the correlation of the centred points (Eqs. 4 and 6).
struct PairMoments {
  double count = 0.0;
  Eigen::Vector3d center_ref_m = Eigen::Vector3d::Zero();  ///< c_m in Eq. 3.
  Eigen::Vector3d center_cur_m = Eigen::Vector3d::Zero();  ///< c_d in Eq. 3.
  Eigen::Matrix3d H_m2 = Eigen::Matrix3d::Zero();          ///< H of Eq. 6: sum of d'_i m'_i^T.
};

/// The four direct solutions of Eq. 2 of Nüchter et al. (2007), as Lorusso, Eggert & Fisher (1995)
/// compare them.
enum class ClosedForm {
  kSvd,             ///< Arun, Huang & Blostein 1987: the choice of Nüchter et al. (2007).
  kUnitQuaternion,  ///< Horn 1987.
  kOrthonormal,     ///< Horn, Hilden & Negahdaripour 1988.
  kDualQuaternion,  ///< Walker, Shao & Volz 1991.
};

inline std::span<const std::pair<std::string_view, ClosedForm>> Names(ClosedForm) {
  static constexpr std::array<std::pair<std::string_view, ClosedForm>, 4> kNames{{
      {"svd", ClosedForm::kSvd},
      {"unit-quaternion", ClosedForm::kUnitQuaternion},
      {"orthonormal", ClosedForm::kOrthonormal},
      {"dual-quaternion", ClosedForm::kDualQuaternion},
  }};
  return kNames;
}

/// The rigid motion (R, t) that minimises sum |m_i - (R d_i + t)|^2 (Nüchter et al. 2007, Eq. 2).
/// All four forms give the same one; nothing when the pairs leave it open (fewer than three, or all
/// on one line).
std::optional<Pose3> AlignPairs(const PairMoments& moments, ClosedForm form);

}  // namespace slam6d
