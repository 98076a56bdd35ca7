// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/config/describe.hpp"
#include "service/config/document_writer.hpp"
#include "service/config/loader.hpp"

namespace qwsm::config {

/// Where options come from, weakest first: the defaults of the struct, a file, settings.
struct OptionSources {
  std::optional<std::filesystem::path> file;
  std::vector<std::string> settings;  ///< `key=value`, as given after --set.
};

/// Loads options from their sources. @throws ConfigError naming every problem at once.
template <class Options>
Options LoadOptions(const OptionSources& sources, Options options = {}) {
  OptionGroup group = GroupOf(options);
  Loader loader(group);
  if (sources.file) loader.ReadFile(*sources.file);
  for (const std::string& setting : sources.settings) loader.Set(setting);
  loader.Finish();
  return options;
}

/// The options as YAML with comments; LoadOptions() reads exactly them back.
template <class Options>
std::string DumpOptions(Options options) {
  return DumpYaml(GroupOf(options));
}

/// A table of all options with their defaults, units, bounds and help.
template <class Options>
std::string DescribeOptions() {
  Options defaults;
  return DescribeAsTable(GroupOf(defaults));
}

}  // namespace qwsm::config
