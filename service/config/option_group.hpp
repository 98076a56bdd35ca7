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

/// Is called by a cross-field check with the name of the field at fault, as in code, and what is
/// wrong.
using FieldReport = std::function<void(std::string_view field, const std::string& what)>;

/// The fields of an options struct, found by its Describe(). Points into the struct it was made
/// from.
struct OptionGroup {
  std::vector<Field> fields;
  /// The struct's Validate(), where it has one.
  std::function<void(const FieldReport&)> validate;

  Field* Find(std::string_view name);
  /// The field that an earlier release called so; null where there is none.
  Field* FindFormer(std::string_view name);
  std::vector<std::string> Names() const;
};

/// An angle, stored in radians and written in degrees.
struct AngleField {
  double* value_rad;
};

/// One choice of several names.
struct ChoiceField {
  std::vector<std::string> names;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};

/// Options repeated in a list. The groups point into the list: adding an item ends those of others.
struct ListField {
  std::function<void()> clear;
  std::function<OptionGroup()> append;  ///< Adds an item with defaults.
  /// Gives the items as they are at the moment.
  std::function<std::vector<OptionGroup>()> items;
  std::function<OptionGroup()> example;  ///< Gives an item with defaults that is not in the list.
};

/// One option: where its value is and what its Describe() says of it.
struct Field {
  std::string name;      ///< Name in YAML: `_deg` where the struct has `_rad`.
  std::string formerly;  ///< Name that an earlier release gave it; empty where there is none.
  std::string help;
  /// Least value, in the unit of the struct: radians.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::variant<double*, AngleField, int*, bool*, std::string*, ChoiceField, OptionGroup, ListField>
      value;
};

/// Name in YAML of a field from its name in code.
std::string YamlName(std::string_view field_name);

/// `between 0 and 10`, `at least 0`, `at most 10` in the unit of the YAML, or nothing.
std::string BoundsText(const Field& field);

/// The value as it is written in YAML; empty for a group or a list.
std::string ValueText(const Field& field);

}  // namespace qwsm::config
