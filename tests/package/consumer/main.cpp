// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Uses headers and compiled code of the installed library, and fails if either is wrong.
#include <cstdlib>
#include <iostream>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/version.hpp"

int main() {
  const qwsm::Pose2 T_map_robot{1.0, 2.0, 0.5};
  const qwsm::Pose2 identity = T_map_robot * T_map_robot.Inverse();
  std::cout << "qwsm " << qwsm::kVersion << '\n';
  return identity.translation_m().norm() < 1e-12 ? EXIT_SUCCESS : EXIT_FAILURE;
}
