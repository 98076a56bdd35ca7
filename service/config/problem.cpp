// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/problem.hpp"

#include <fmt/format.h>

#include <utility>

namespace qwsm::config {
namespace {

std::string JoinLines(const std::vector<Problem>& problems) {
  std::string lines;
  for (const Problem& problem : problems) {
    if (!lines.empty()) lines += '\n';
    lines += ToString(problem);
  }
  return lines;
}

}  // namespace

std::string ToString(const Problem& problem) {
  const Location& at = problem.location;
  std::string text = at.source;
  if (at.line > 0) text += fmt::format(":{}:{}", at.line, at.column);
  if (!problem.key.empty()) text += ": " + problem.key;
  return text + ": " + problem.what;
}

ConfigError::ConfigError(std::vector<Problem> problems)
    : std::runtime_error(JoinLines(problems)), problems_(std::move(problems)) {}

}  // namespace qwsm::config
