// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/program_options.hpp"

namespace qwsm::config {

template OptionGroup GroupOf(ProgramOptions& options);

}  // namespace qwsm::config
