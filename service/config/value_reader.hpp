// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "service/config/option_group.hpp"
#include "service/config/yaml_document.hpp"

namespace qwsm::config {

/// Puts a value that was read into the option. Returns what is wrong with it, in which case the
/// option keeps its value.
/// @pre `field` is neither a group nor a list.
std::optional<std::string> AssignValue(Field& field, const YamlNode& value);

}  // namespace qwsm::config
