// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// One line of a table with columns divided by commas.
class CsvRow {
 public:
  void Add(double value);
  void Add(Timestamp stamp);
  /// @pre no comma or quote in it: our own words.
  void Add(std::string_view word);

  /// The line, with its end. @pre something was added.
  const std::string& Finish();

 private:
  std::string text_;
};

}  // namespace qwsm::io
