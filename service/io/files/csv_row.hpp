// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// One line of a table with columns divided by commas.
class CsvRow {
 public:
  void Add(double value);
  void Add(Timestamp stamp);
  /// Adds nine columns: x, y and theta, and the upper triangle of their covariance, row by row.
  void Add(const UncertainPose2& pose);
  /// Adds as many, which are empty where there is none.
  void Add(const std::optional<UncertainPose2>& pose);
  /// Adds a word of our own. @pre it has no comma or quote.
  void Add(std::string_view word);

  /// Gives the line, with its end. @pre something was added.
  const std::string& Finish();

 private:
  std::string text_;
};

}  // namespace qwsm::io
