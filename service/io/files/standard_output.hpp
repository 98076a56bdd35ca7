// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/io/files/atomic_file.hpp"

namespace qwsm::io {

/// Error of standard output that did not take what was written, with the system's reason: to be
/// thrown right after the write that failed.
WriteError StandardOutputError();

}  // namespace qwsm::io
