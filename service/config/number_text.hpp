// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace qwsm::config {

/// The number that a text spells, or nothing unless all of the text is one. Independent of the
/// locale; "inf", "nan" and numbers beyond a double's range are nothing.
std::optional<double> ParseNumber(std::string_view text);
std::optional<int> ParseWholeNumber(std::string_view text);

/// The shortest text ParseNumber() reads back as exactly this number.
std::string NumberText(double value);

/// Radians of an angle written in degrees. Up to 17 digits this is
/// DegreesToRadians(ParseNumber(text)), as in code; longer texts are read in extended precision,
/// since not every double in radians has a double in degrees that leads to it.
std::optional<double> ParseDegrees(std::string_view text);

/// The shortest text in degrees ParseDegrees() reads back as exactly this angle.
std::string DegreesText(double angle_rad);

}  // namespace qwsm::config
