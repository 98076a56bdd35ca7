// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/number_arguments.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "service/config/number_text.hpp"

namespace qwsm::apps {

CLI::Validator NumberBetween(double least, double most) {
  const auto objection = [least, most](const std::string& text) -> std::string {
    const std::optional<double> number = config::ParseNumber(text);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("must be a number between {} and {}, got '{}'", least, most, text);
  };
  return {objection, ""};
}

}  // namespace qwsm::apps
