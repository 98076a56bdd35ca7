// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slam6d::apps {

/// The program slam6d, from its arguments to its exit code.
int RunSlam6d(int argc, char** argv);

}  // namespace slam6d::apps
