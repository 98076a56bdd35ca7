// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/option_group.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "qwsm/geometry/angle.hpp"
#include "service/config/number_text.hpp"

namespace qwsm::config {
namespace {

constexpr std::string_view kRadians = "_rad";
constexpr std::string_view kDegrees = "_deg";

std::string BoundText(const Field& field, double bound) {
  // Bounds are round numbers, if not always in degrees; nobody wants to read 89.99999999999999.
  const bool is_angle = std::holds_alternative<AngleField>(field.value);
  return is_angle ? fmt::format("{:.4g}", RadiansToDegrees(bound)) : fmt::format("{:.10g}", bound);
}

/// In single quotes YAML takes everything as it stands, but for the quote itself.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? "''" : std::string(1, letter);
  return quoted + "'";
}

struct ValuePrinter {
  std::string operator()(const double* value) const { return NumberText(*value); }
  std::string operator()(const AngleField& angle) const { return DegreesText(*angle.value_rad); }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const std::string* value) const { return Quoted(*value); }
  std::string operator()(const ChoiceField& choice) const { return choice.names[choice.get()]; }
  std::string operator()(const OptionGroup&) const { return {}; }
  std::string operator()(const ListField&) const { return {}; }
};

}  // namespace

Field* OptionGroup::Find(std::string_view name) {
  const auto found = std::ranges::find(fields, name, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

Field* OptionGroup::FindFormer(std::string_view name) {
  if (name.empty()) return nullptr;
  const auto found = std::ranges::find(fields, name, &Field::formerly);
  return found == fields.end() ? nullptr : &*found;
}

std::vector<std::string> OptionGroup::Names() const {
  std::vector<std::string> names;
  for (const Field& field : fields) names.push_back(field.name);
  return names;
}

std::string YamlName(std::string_view field_name) {
  std::string name(field_name);
  if (name.ends_with(kRadians))
    name.replace(name.size() - kRadians.size(), kRadians.size(), kDegrees);
  return name;
}

std::string BoundsText(const Field& field) {
  const bool has_min = std::isfinite(field.min);
  const bool has_max = std::isfinite(field.max);
  if (has_min && has_max) {
    return fmt::format(
        "between {} and {}", BoundText(field, field.min), BoundText(field, field.max));
  }
  if (has_min) return "at least " + BoundText(field, field.min);
  if (has_max) return "at most " + BoundText(field, field.max);
  return {};
}

std::string ValueText(const Field& field) { return std::visit(ValuePrinter{}, field.value); }

}  // namespace qwsm::config
