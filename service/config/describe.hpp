// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "service/config/option_group.hpp"

namespace qwsm::config {

/// What Describe() says of a field. Bounds are inclusive and in the unit of the struct.
struct FieldInfo {
  std::string_view help;
  /// Name in earlier releases; it is refused with the new one named.
  std::string_view formerly{};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

template <class Options>
OptionGroup GroupOf(Options& options);

/// Collects the fields an options struct names in its `Describe(visitor, options)`.
class FieldCollector {
 public:
  template <class Value>
  void operator()(std::string_view name, Value& value, const FieldInfo& info) {
    Field field;
    field.name = YamlName(name);
    field.formerly = YamlName(info.formerly);
    field.help = info.help;
    field.min = info.min;
    field.max = info.max;
    if constexpr (std::is_same_v<Value, double>) {
      if (field.name != name) {
        field.value = AngleField{&value};
      } else {
        field.value = &value;
      }
    } else if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, bool> ||
                         std::is_same_v<Value, std::string>) {
      field.value = &value;
    } else if constexpr (std::is_enum_v<Value>) {
      field.value = ChoiceOf(value);
    } else {
      field.value = GroupOf(value);
    }
    group_.fields.push_back(std::move(field));
  }

  template <class Item>
  void operator()(std::string_view name, std::vector<Item>& items, const FieldInfo& info) {
    ListField list;
    list.clear = [&items] { items.clear(); };
    list.append = [&items] { return GroupOf(items.emplace_back()); };
    list.items = [&items] {
      std::vector<OptionGroup> groups;
      for (Item& item : items) groups.push_back(GroupOf(item));
      return groups;
    };
    list.example = [item = std::make_shared<Item>()] { return GroupOf(*item); };
    Field field;
    field.name = name;
    field.formerly = info.formerly;
    field.help = info.help;
    field.value = std::move(list);
    group_.fields.push_back(std::move(field));
  }

  OptionGroup Take() { return std::move(group_); }

 private:
  /// A choice of the names in `Names(Enum)`, a range of (name, enumerator) pairs that stands beside
  /// the enumeration.
  template <class Enum>
  static ChoiceField ChoiceOf(Enum& value) {
    ChoiceField choice;
    for (const auto& [name, enumerator] : Names(value)) choice.names.emplace_back(name);
    choice.get = [&value] {
      std::size_t index = 0;
      for (const auto& [name, enumerator] : Names(value)) {
        if (enumerator == value) break;
        ++index;
      }
      return index;
    };
    choice.set = [&value](std::size_t index) { value = Names(value)[index].second; };
    return choice;
  }

  OptionGroup group_;
};

/// The fields of any options struct, by its Describe(); its cross-field checks by its optional
/// `Validate(options, report)`, which calls `report("field", "what is wrong")`.
/// @pre `options` outlives the group.
template <class Options>
OptionGroup GroupOf(Options& options) {
  FieldCollector collector;
  Describe(collector, options);
  OptionGroup group = collector.Take();
  if constexpr (requires(const FieldReport& report) { Validate(options, report); }) {
    group.validate = [&options](const FieldReport& report) { Validate(options, report); };
  }
  return group;
}

}  // namespace qwsm::config
