// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace qwsm::io {

/// The smallest of 1, 2 or 5 times a power of ten that is not below `value`.
/// @pre value > 0 and finite.
double RoundUpToNice(double value);

/// Nice values from `low` to `high` at a nice distance, about `count` of them.
/// @pre low < high, both finite, count > 0.
std::vector<double> Ticks(double low, double high, int count);

/// A number for people: no more decimals than `step` needs, no trailing zeros; thousands apart by a
/// thin space.
std::string TickLabel(double value, double step);

/// A length for people: "50 cm", "2 m", "1.5 km".
std::string LengthLabel(double length_m);

}  // namespace qwsm::io
