// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace qwsm::config {

/// Where something was said: a place in a file, or an argument such as `--set mapper.noise=1`.
struct Location {
  std::string source;
  int line = 0;    ///< Counted from 1; 0 where the source has no lines.
  int column = 0;  ///< Counted from 1, in bytes.
};

/// One thing wrong with a configuration.
struct Problem {
  Location location;
  /// Dotted name, such as `mapper.matcher.max_iterations`; empty for a syntax error.
  std::string key;
  std::string what;
};

/// The problem as `file:line:column: key: what is wrong`, the form editors jump to.
std::string ToString(const Problem& problem);

/// Tells that a configuration was refused. what() has one line per problem, none of which were
/// silently repaired; they are in the order in which a reader meets them: file by file, line by
/// line.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace qwsm::config
