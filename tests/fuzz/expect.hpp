// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <cstdlib>

namespace qwsm::test {

/// Crashes unless `holds`, and says where: how a fuzzer tells that it found something.
/// Unlike assert it is never compiled out.
inline void Expect(bool holds, int line = __builtin_LINE()) {
  if (holds) return;
  std::fprintf(stderr, "what line %d expects does not hold\n", line);
  std::abort();
}

}  // namespace qwsm::test
