// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/scenario.hpp"

namespace sim {

/// Walks through options by their Describe() and notes values out of their bounds and what their
/// Validate() reports, so that options made in code are held to the same rules as those of files.
class Inspection {
 public:
  template <class Options>
  void Inspect(Options& options) {
    const std::size_t problems_before = problems_.size();
    Describe(*this, options);
    const auto report = [this](std::string_view field, const std::string& what) {
      problems_.push_back({prefix_ + std::string(field), what});
    };
    // Rules between options make sense only where each option does.
    if (problems_.size() > problems_before) return;
    if constexpr (requires { Validate(options, report); }) Validate(options, report);
  }

  struct FieldInfo {
    std::string_view help;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
  };

  /// Is called by Describe() for each field.
  template <class Value>
  void operator()(std::string_view name, Value& value, const FieldInfo& info) {
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int>) {
      Check(name, static_cast<double>(value), info);
    } else if constexpr (std::is_class_v<Value> && !std::is_same_v<Value, std::string>) {
      InspectWithin(std::string(name) + '.', value);
    }
  }

  template <class Item>
  void operator()(std::string_view name, std::vector<Item>& items, const FieldInfo&) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      InspectWithin(std::string(name) + '[' + std::to_string(i) + "].", items[i]);
    }
  }

  std::vector<ScenarioProblem> Take() { return std::move(problems_); }

 private:
  template <class Options>
  void InspectWithin(const std::string& step, Options& options) {
    const std::string prefix_before = prefix_;
    prefix_ += step;
    Inspect(options);
    prefix_ = prefix_before;
  }

  void Check(std::string_view name, double value, const FieldInfo& info) {
    if (value >= info.min && value <= info.max) return;
    std::ostringstream what;
    what << "must be between " << info.min << " and " << info.max << ", got " << value;
    problems_.push_back({prefix_ + std::string(name), what.str()});
  }

  std::string prefix_;
  std::vector<ScenarioProblem> problems_;
};

}  // namespace sim
