// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// Appends a number with as many digits as it takes to read the same number back, whatever the
/// locale.
void AppendNumber(std::string& text, double value);
void AppendNumber(std::string& text, float value);

/// Appends seconds with all nine decimals.
void AppendStamp(std::string& text, Timestamp stamp);

}  // namespace qwsm::io
