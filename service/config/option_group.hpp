// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace qwsm::config {

struct Field;

/// Called by a cross-field check with the name of the field at fault, as in code, and what is
/// wrong.
using FieldReport = std::function<void(std::string_view field, const std::string& what)>;

/// The fields of an options struct, found by its Describe(). Points into the struct it was made
/// from.
struct OptionGroup {
  std::vector<Field> fields;
  std::function<void(const FieldReport&)> validate;  ///< The struct's Validate(), if it has one.

  Field* Find(std::string_view name);
  /// The field that an earlier release called so.
  Field* FindFormer(std::string_view name);
  std::vector<std::string> Names() const;
};

/// An angle: stored in radians, written in degrees.
struct AngleField {
  double* value_rad;
};

/// One of several names.
struct ChoiceField {
  std::vector<std::string> names;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};

/// Options repeated in a list. The groups point into the list: adding an item ends those of others.
struct ListField {
  std::function<void()> clear;
  std::function<OptionGroup()> append;              ///< Adds an item with defaults.
  std::function<std::vector<OptionGroup>()> items;  ///< As they are now.
  std::function<OptionGroup()> example;             ///< An item with defaults, not of the list.
};

/// One option: where its value is and what its Describe() says of it.
struct Field {
  std::string name;      ///< As written in YAML: `_deg` where the struct has `_rad`.
  std::string formerly;  ///< What an earlier release called it; empty if nothing else.
  std::string help;
  double min = -std::numeric_limits<double>::infinity();  ///< In the unit of the struct: radians.
  double max = std::numeric_limits<double>::infinity();
  std::variant<double*, AngleField, int*, bool*, std::string*, ChoiceField, OptionGroup, ListField>
      value;
};

/// The name in YAML of a field called so in code.
std::string YamlName(std::string_view field_name);

/// `between 0 and 10`, `at least 0`, `at most 10` in the unit of the YAML, or nothing.
std::string BoundsText(const Field& field);

/// The value as it is written in YAML; empty for a group or a list.
std::string ValueText(const Field& field);

}  // namespace qwsm::config
