// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "service/config/options_io.hpp"

namespace qwsm::python {

/// The entries of a dictionary as settings `key=value`; dictionaries within it are groups.
inline void AddSettings(const pybind11::dict& options,
                        const std::string& prefix,
                        std::vector<std::string>& settings) {
  for (const auto& [name, value] : options) {
    const std::string key = prefix + std::string(pybind11::str(name));
    if (pybind11::isinstance<pybind11::dict>(value)) {
      AddSettings(pybind11::reinterpret_borrow<pybind11::dict>(value), key + ".", settings);
    } else if (pybind11::isinstance<pybind11::bool_>(value)) {
      settings.push_back(key + (value.cast<bool>() ? "=true" : "=false"));
    } else {
      settings.push_back(key + "=" + std::string(pybind11::str(value)));
    }
  }
}

/// The same problems without the argument of the programs that settings are given by.
inline config::ConfigError WithoutArgument(const config::ConfigError& error) {
  constexpr std::string_view kArgument = "--set";
  std::vector<config::Problem> problems = error.problems();
  for (config::Problem& problem : problems) {
    std::string& source = problem.location.source;
    if (source.starts_with(kArgument)) source.replace(0, kArgument.size(), "option");
  }
  return config::ConfigError(std::move(problems));
}

/// Options by their names in YAML, such as {"relevant_translation_m": 0.3} or {"motion": {...}};
/// what is not named keeps its default. @throws config::ConfigError naming every problem at once.
template <class Options>
Options OptionsFrom(const pybind11::dict& options) {
  config::OptionSources sources;
  AddSettings(options, "", sources.settings);
  try {
    return config::LoadOptions<Options>(sources);
  } catch (const config::ConfigError& error) {
    throw WithoutArgument(error);
  }
}

}  // namespace qwsm::python
