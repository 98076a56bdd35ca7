// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/output.hpp"

#include <cstdio>

#include "service/io/files/standard_output.hpp"

namespace qwsm::apps {

void PrintText(std::string_view text) {
  const bool is_complete = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_complete && std::fflush(stdout) == 0) return;
  throw io::StandardOutputError();
}

}  // namespace qwsm::apps
