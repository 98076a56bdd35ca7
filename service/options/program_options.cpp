// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/options/program_options.hpp"

namespace qwsm::config {

template OptionGroup GroupOf(options::ProgramOptions& options);

}  // namespace qwsm::config
