// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/number_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "qwsm/geometry/angle.hpp"

namespace qwsm::config {
namespace {

// The digits from which a text is taken to mean more than a double can hold.
constexpr int kExtendedDigits = 18;
// Up to here "90" reads better than "9e+01".
constexpr int kPlainDigits = 6;
// Enough for every 64-bit mantissa.
constexpr int kMostDigits = 21;

template <class Number>
std::optional<Number> Parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <class Number>
std::optional<Number> ParseFinite(std::string_view text) {
  const std::optional<Number> value = Parse<Number>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

int CountSignificantDigits(std::string_view text) {
  int digits = 0;
  for (const char c : text) {
    if (c == 'e' || c == 'E') break;
    const bool counts = (c > '0' && c <= '9') || (c == '0' && digits > 0);
    if (counts) ++digits;
  }
  return digits;
}

double RadiansFromExtended(long double angle_deg) {
  return static_cast<double>(angle_deg * std::numbers::pi_v<long double> / 180.0L);
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) { return ParseFinite<double>(text); }

std::optional<int> ParseWholeNumber(std::string_view text) { return Parse<int>(text); }

std::string NumberText(double value) { return fmt::format("{}", value); }

std::optional<double> ParseDegrees(std::string_view text) {
  if (CountSignificantDigits(text) < kExtendedDigits) {
    const std::optional<double> angle_deg = ParseNumber(text);
    if (!angle_deg) return std::nullopt;
    return DegreesToRadians(*angle_deg);
  }
  const std::optional<long double> angle_deg = ParseFinite<long double>(text);
  if (!angle_deg || !std::isfinite(RadiansFromExtended(*angle_deg))) return std::nullopt;
  return RadiansFromExtended(*angle_deg);
}

std::string DegreesText(double angle_rad) {
  const long double angle_deg =
      static_cast<long double>(angle_rad) * 180.0L / std::numbers::pi_v<long double>;
  std::string text;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    // Trailing zeros count where the number of digits decides how the text is read.
    text = digits < kExtendedDigits ? fmt::format("{:.{}g}", angle_deg, digits)
                                    : fmt::format("{:#.{}g}", angle_deg, digits);
    const bool shorter_without_exponent =
        digits < kPlainDigits && std::abs(angle_deg) >= 1.0L && text.find('e') != std::string::npos;
    if (!shorter_without_exponent && ParseDegrees(text) == angle_rad) break;
  }
  return text;
}

}  // namespace qwsm::config
