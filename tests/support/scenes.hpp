// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/support/world.hpp"

/// Scenes that tests, benchmarks and the demonstration share. None stands along the axes.
namespace qwsm::test {

/// A furnished room of 10 m by 8 m; once around.
Scene FurnishedRoom();

/// Two furnished rooms at either end of a corridor, 28 m long in all; there and back again.
Scene TwoRoomsAndCorridor();

/// A corridor of 60 m by 2 m whose only feature is one open door half way; there and back.
Scene LongCorridor();

/// A lawn of 48 m by 28 m with a tree here and there: a laser that looks ahead and sees 11 m sees
/// one or two of them most of the time. Once around.
Scene Park();

/// Offices of 36 m by 22 m on both sides of a corridor that closes on itself; once around it, and
/// half a side further.
Scene OfficeLoop();

}  // namespace qwsm::test
