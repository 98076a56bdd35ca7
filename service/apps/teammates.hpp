// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/pipeline/run/replay.hpp"

namespace qwsm::apps {

/// Answers to what a robot of a team sees without whatever moves there as a robot does. Along a
/// corridor one that comes along is all there is to be matched with, and holds the robot back.
pipeline::Answer WithoutTeammates(pipeline::Answer answer);

}  // namespace qwsm::apps
