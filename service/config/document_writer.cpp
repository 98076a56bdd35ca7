// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/document_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "service/config/text_table.hpp"

namespace qwsm::config {
namespace {

std::string AllowedText(const Field& field) {
  if (const auto* choice = std::get_if<ChoiceField>(&field.value)) {
    return fmt::format("{}", fmt::join(choice->names, " | "));
  }
  if (std::holds_alternative<bool*>(field.value)) return "true | false";
  return BoundsText(field);
}

void Dump(const OptionGroup& group, const std::string& indent, std::string& yaml) {
  for (const Field& field : group.fields) {
    const std::string allowed = AllowedText(field);
    yaml +=
        fmt::format("{}# {}{}\n", indent, field.help, allowed.empty() ? "" : " (" + allowed + ")");
    yaml += indent + field.name + ":";
    if (const auto* nested = std::get_if<OptionGroup>(&field.value)) {
      yaml += '\n';
      Dump(*nested, indent + "  ", yaml);
    } else if (const auto* list = std::get_if<ListField>(&field.value)) {
      const std::vector<OptionGroup> items = list->items();
      yaml += items.empty() ? " []\n" : "\n";
      for (const OptionGroup& item : items) {
        yaml += indent + "  -\n";
        Dump(item, indent + "    ", yaml);
      }
    } else {
      yaml += " " + ValueText(field) + "\n";
    }
  }
}

/// The unit a name ends in, as it is written in tables.
std::string UnitOf(std::string_view name) {
  using Unit = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Unit, 9> kUnits{{{"_m", "m"},
                                               {"_mm", "mm"},
                                               {"_m2", "m^2"},
                                               {"_deg", "deg"},
                                               {"_rad", "rad"},
                                               {"_s", "s"},
                                               {"_ms", "ms"},
                                               {"_hz", "Hz"},
                                               {"_px", "px"}}};
  const auto found =
      std::ranges::find_if(kUnits, [name](const Unit& unit) { return name.ends_with(unit.first); });
  return found == kUnits.end() ? std::string() : std::string(found->second);
}

void AddRows(const OptionGroup& group,
             const std::string& prefix,
             std::vector<std::vector<std::string>>& rows) {
  for (const Field& field : group.fields) {
    const std::string key = prefix + field.name;
    if (const auto* nested = std::get_if<OptionGroup>(&field.value)) {
      AddRows(*nested, key + ".", rows);
    } else if (const auto* list = std::get_if<ListField>(&field.value)) {
      AddRows(list->example(), key + "[].", rows);
    } else {
      rows.push_back({key, ValueText(field), UnitOf(field.name), AllowedText(field), field.help});
    }
  }
}

}  // namespace

std::string DumpYaml(const OptionGroup& group) {
  std::string yaml;
  Dump(group, "", yaml);
  return yaml;
}

std::string DescribeAsTable(const OptionGroup& group) {
  std::vector<std::vector<std::string>> rows{
      {"option", "default", "unit", "allowed", "what it does"}};
  AddRows(group, "", rows);
  return FormatTable(rows);
}

}  // namespace qwsm::config
