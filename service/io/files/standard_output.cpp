// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/standard_output.hpp"

#include <cerrno>
#include <system_error>

namespace qwsm::io {

WriteError StandardOutputError() {
  return WriteError("standard output cannot be written: " + std::generic_category().message(errno));
}

}  // namespace qwsm::io
