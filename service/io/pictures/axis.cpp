// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace qwsm::io {
namespace {

// Rounding must not turn 0.2 into something a bit above 2 * 0.1.
constexpr double kTolerance = 1e-9;

std::string Fixed(double value, int decimals) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

}  // namespace

double RoundUpToNice(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value) + kTolerance));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * decade * (1.0 + kTolerance)) return step * decade;
  }
  return 10.0 * decade;
}

std::vector<double> Ticks(double low, double high, int count) {
  const double step = RoundUpToNice((high - low) / count);
  std::vector<double> ticks;
  const double first = std::ceil(low / step - kTolerance);
  for (double index = first; index * step <= high + kTolerance * step; ++index) {
    ticks.push_back(index * step);
  }
  return ticks;
}

std::string TickLabel(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - kTolerance)));
  std::string text = Fixed(std::abs(value), decimals);
  if (text.find_first_not_of("0.") == std::string::npos) return "0";
  const std::size_t whole_digits = std::min(text.find('.'), text.size());
  for (std::size_t at = whole_digits; at > 3 && whole_digits > 4;) {
    at -= 3;
    text.insert(at, "\u2009");
  }
  return value < 0.0 ? "\u2212" + text : text;
}

std::string LengthLabel(double length_m) {
  const auto label = [](double value, const char* unit) {
    std::string text = Fixed(value, 3);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + ' ' + unit;
  };
  if (length_m >= 1000.0) return label(length_m / 1000.0, "km");
  if (length_m >= 1.0) return label(length_m, "m");
  return label(100.0 * length_m, "cm");
}

}  // namespace qwsm::io
