// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace qwsm::apps {

/// The program qwsm, from its arguments to its exit code.
int RunQwsm(int argc, char** argv);

}  // namespace qwsm::apps
