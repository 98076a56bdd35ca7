// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "service/config/number_text.hpp"

namespace qwsm::config {
namespace {

struct Column {
  std::size_t width = 0;
  bool is_numeric = true;
};

std::vector<Column> Measure(const std::vector<std::vector<std::string>>& rows) {
  std::vector<Column> columns;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    columns.resize(std::max(columns.size(), rows[row].size()));
    for (std::size_t i = 0; i < rows[row].size(); ++i) {
      const std::string& cell = rows[row][i];
      columns[i].width = std::max(columns[i].width, cell.size());
      const bool may_be_number = row == 0 || cell.empty() || cell == "-" || ParseNumber(cell);
      columns[i].is_numeric = columns[i].is_numeric && may_be_number;
    }
  }
  return columns;
}

}  // namespace

std::string FormatTable(const std::vector<std::vector<std::string>>& rows) {
  const std::vector<Column> columns = Measure(rows);
  std::string table;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line += "  ";
      line += columns[i].is_numeric ? fmt::format("{:>{}}", row[i], columns[i].width)
                                    : fmt::format("{:<{}}", row[i], columns[i].width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
  }
  return table;
}

}  // namespace qwsm::config
