// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/csv_row.hpp"

#include <cassert>
#include <cstddef>

#include "service/io/files/number_text.hpp"

namespace qwsm::io {

void CsvRow::Add(double value) {
  AppendNumber(text_, value);
  text_ += ',';
}

void CsvRow::Add(Timestamp stamp) {
  AppendStamp(text_, stamp);
  text_ += ',';
}

void CsvRow::Add(const UncertainPose2& pose) {
  for (const double number : {pose.T_a_b.x_m, pose.T_a_b.y_m, pose.T_a_b.theta_rad}) Add(number);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) Add(pose.covariance(i, j));
  }
}

void CsvRow::Add(const std::optional<UncertainPose2>& pose) {
  constexpr std::size_t kColumns = 9;
  if (pose) return Add(*pose);
  text_.append(kColumns, ',');
}

void CsvRow::Add(std::string_view word) {
  text_ += word;
  text_ += ',';
}

const std::string& CsvRow::Finish() {
  assert(!text_.empty() && "a row has at least one column");
  text_.back() = '\n';
  return text_;
}

}  // namespace qwsm::io
