// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/support/world.hpp"

/// Scenes that tests, benchmarks and the demonstration share. None stands along the axes.
namespace qwsm::test {

/// Two furnished rooms at either end of a corridor, 28 m long in all; there and back again.
Scene TwoRoomsAndCorridor();

/// A corridor of 60 m by 2 m whose only feature is one open door half way; there and back.
Scene LongCorridor();

/// Offices of 36 m by 22 m on both sides of a corridor that closes on itself; once around it, and
/// half a side further.
Scene OfficeLoop();

}  // namespace qwsm::test
