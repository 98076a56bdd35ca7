// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/config/option_group.hpp"

namespace qwsm::config {

/// All options with their values as YAML, with help, unit and bounds as comments. Reading it gives
/// the same options back, bit by bit.
std::string DumpYaml(const OptionGroup& group);

/// A table for people: option, default, unit, bounds, help.
std::string DescribeAsTable(const OptionGroup& group);

}  // namespace qwsm::config
