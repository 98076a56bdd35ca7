// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "service/io/files/binary.hpp"

namespace qwsm::io {

/// Options as (name, value) pairs, so that a file outlives options that are added later.
using OptionValues = std::map<std::string, std::variant<double, std::string>, std::less<>>;

struct OptionFieldInfo {
  std::string_view help;
  std::string_view formerly{};  ///< Name in files of earlier releases.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Collects the values that an options struct has, by its Describe().
class OptionCollector {
 public:
  template <class Value>
  void operator()(std::string_view name, Value& value, const OptionFieldInfo&) {
    const std::string key = prefix_ + std::string(name);
    if constexpr (std::is_arithmetic_v<Value>) {
      values[key] = static_cast<double>(value);
    } else if constexpr (std::is_enum_v<Value>) {
      for (const auto& [known, enumerator] : Names(value)) {
        if (enumerator == value) values[key] = std::string(known);
      }
    } else {
      const std::string outer = prefix_;
      prefix_ = key + ".";
      Describe(*this, value);
      prefix_ = outer;
    }
  }

  OptionValues values;

 private:
  std::string prefix_;
};

/// Gives an options struct the values that were collected, taking each out as it is used: what is
/// left is unknown to the struct. Fields that are not among them keep their value. A value under
/// the name that an earlier release gave its field is taken as well.
/// @throws BinaryError where a value is not one the field can have.
class OptionRestorer {
 public:
  explicit OptionRestorer(OptionValues& values) : values_(values) {}

  template <class Value>
  void operator()(std::string_view name, Value& value, const OptionFieldInfo& info) {
    const std::string key = prefix_ + std::string(name);
    if (!info.formerly.empty()) Rename(prefix_ + std::string(info.formerly), key);
    if constexpr (std::is_arithmetic_v<Value>) {
      OptionFieldInfo bounds = info;
      bounds.min = std::max(info.min, static_cast<double>(std::numeric_limits<Value>::lowest()));
      bounds.max = std::min(info.max, static_cast<double>(std::numeric_limits<Value>::max()));
      Restore(key, bounds, [&value](double number) { value = static_cast<Value>(number); });
    } else if constexpr (std::is_enum_v<Value>) {
      const auto found = values_.find(key);
      if (found == values_.end()) return;
      const auto* word = std::get_if<std::string>(&found->second);
      bool is_known = false;
      for (const auto& [known, enumerator] : Names(value)) {
        if (word == nullptr || known != *word) continue;
        value = enumerator;
        is_known = true;
      }
      if (!is_known) throw BinaryError("the option " + key + " has an unknown value");
      values_.erase(found);
    } else {
      const std::string outer = prefix_;
      prefix_ = key + ".";
      Describe(*this, value);
      prefix_ = outer;
    }
  }

 private:
  /// Renames a value, and all values of a group, of that name.
  void Rename(const std::string& from, const std::string& to) {
    for (auto found = values_.lower_bound(from);
         found != values_.end() && found->first.starts_with(from);) {
      const auto next = std::next(found);
      const std::string rest = found->first.substr(from.size());
      if (rest.empty() || rest.front() == '.') {
        auto node = values_.extract(found);
        node.key() = to + rest;
        values_.insert(std::move(node));
      }
      found = next;
    }
  }

  template <class Store>
  void Restore(const std::string& key, const OptionFieldInfo& bounds, Store store) {
    const auto found = values_.find(key);
    if (found == values_.end()) return;
    const auto* number = std::get_if<double>(&found->second);
    // Written so that NaN fails the test.
    if (number == nullptr || !(*number >= bounds.min && *number <= bounds.max)) {
      throw BinaryError("the option " + key + " is out of bounds");
    }
    store(*number);
    values_.erase(found);
  }

  OptionValues& values_;
  std::string prefix_;
};

void AddOptions(BinaryWriter& writer, const OptionValues& values);
OptionValues ReadOptions(BinaryReader& reader);

}  // namespace qwsm::io
