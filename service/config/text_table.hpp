// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace qwsm::config {

/// Rows of cells as text with aligned columns, the first row being the heading. Columns of numbers
/// are aligned to the right. Cells are counted in bytes, so ASCII only.
std::string FormatTable(const std::vector<std::vector<std::string>>& rows);

}  // namespace qwsm::config
