// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/value_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "service/config/number_text.hpp"
#include "service/config/suggestion.hpp"

namespace qwsm::config {
namespace {

using Kind = YamlNode::Kind;

/// What was found, for messages; long texts are cut.
std::string Quote(const YamlNode& value) {
  constexpr std::size_t kLongest = 40;
  switch (value.kind) {
    case Kind::kNothing:
      return "nothing";
    case Kind::kSequence:
      return "a list";
    case Kind::kMap:
      return "a group";
    case Kind::kPlain:
    case Kind::kQuoted:
      break;
  }
  const bool is_long = value.text.size() > kLongest;
  return "'" + (is_long ? value.text.substr(0, kLongest) + "..." : value.text) + "'";
}

bool IsNonFinite(const std::string& text) {
  static constexpr std::string_view kSpellings[] = {
      ".nan", ".inf", "-.inf", "+.inf", "nan", "inf", "-inf"};
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return std::ranges::find(kSpellings, lower) != std::end(kSpellings);
}

class ValueReader {
 public:
  ValueReader(const Field& field, const YamlNode& value) : field_(field), value_(value) {}

  std::optional<std::string> operator()(double* target) const {
    return Store(ParseNumber(PlainText()), *target);
  }
  std::optional<std::string> operator()(const AngleField& angle) const {
    return Store(ParseDegrees(PlainText()), *angle.value_rad);
  }

  std::optional<std::string> operator()(int* target) const {
    const std::optional<int> number = ParseWholeNumber(PlainText());
    if (!number) return "expected a whole number, got " + Quote(value_);
    if (!IsInBounds(*number)) return OutOfBounds();
    *target = *number;
    return std::nullopt;
  }

  std::optional<std::string> operator()(bool* target) const {
    if (PlainText() != "true" && PlainText() != "false") {
      return "expected true or false, got " + Quote(value_);
    }
    *target = PlainText() == "true";
    return std::nullopt;
  }

  std::optional<std::string> operator()(std::string* target) const {
    if (value_.kind != Kind::kPlain && value_.kind != Kind::kQuoted) {
      return "expected a text, got " + Quote(value_);
    }
    *target = value_.text;
    return std::nullopt;
  }

  std::optional<std::string> operator()(const ChoiceField& choice) const {
    const auto found = std::ranges::find(choice.names, value_.text);
    const bool is_scalar = value_.kind == Kind::kPlain || value_.kind == Kind::kQuoted;
    if (!is_scalar || found == choice.names.end()) {
      return fmt::format("must be one of {}, got {}{}",
                         fmt::join(choice.names, ", "),
                         Quote(value_),
                         DidYouMean(value_.text, choice.names));
    }
    choice.set(static_cast<std::size_t>(found - choice.names.begin()));
    return std::nullopt;
  }

  std::optional<std::string> operator()(const OptionGroup&) const { return std::nullopt; }
  std::optional<std::string> operator()(const ListField&) const { return std::nullopt; }

 private:
  /// Empty, and so no number, for anything but a plain scalar.
  std::string PlainText() const {
    return value_.kind == Kind::kPlain ? value_.text : std::string();
  }

  std::optional<std::string> Store(std::optional<double> number, double& target) const {
    if (!number) {
      const bool finite = !IsNonFinite(PlainText());
      return (finite ? "expected a number, got " : "must be finite, got ") + Quote(value_);
    }
    if (!IsInBounds(*number)) return OutOfBounds();
    target = *number;
    return std::nullopt;
  }

  bool IsInBounds(double number) const {
    // 90 degrees must not exceed a bound of pi / 2 by rounding.
    const double slack = std::holds_alternative<AngleField>(field_.value) ? 1e-12 : 0.0;
    return number >= field_.min - slack && number <= field_.max + slack;
  }

  std::string OutOfBounds() const {
    return fmt::format("must be {}, got {}", BoundsText(field_), value_.text);
  }

  const Field& field_;
  const YamlNode& value_;
};

}  // namespace

std::optional<std::string> AssignValue(Field& field, const YamlNode& value) {
  return std::visit(ValueReader(field, value), field.value);
}

}  // namespace qwsm::config
