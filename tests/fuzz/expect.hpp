// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>

namespace qwsm::test {

/// Crashes unless `holds`: how a fuzzer tells that it found something. Unlike assert it is never
/// compiled out.
inline void Expect(bool holds) {
  if (!holds) std::abort();
}

}  // namespace qwsm::test
