// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace qwsm {

/// The inverse in the directions that A tells of, and zero in the others (Moore and Penrose).
///
/// Stands in a source of its own because Eigen's decomposition takes longer to compile than any
/// source that needs it.
Eigen::Matrix3d PseudoInverse(const Eigen::Matrix3d& A);

}  // namespace qwsm
