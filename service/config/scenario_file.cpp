// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/scenario_file.hpp"

#include <fmt/ranges.h>

#include <map>
#include <system_error>
#include <vector>

#include "service/config/problem.hpp"
#include "service/config/suggestion.hpp"

namespace qwsm::config {

namespace fs = std::filesystem;

namespace {

std::map<std::string, fs::path> ShippedScenarios() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::map<std::string, fs::path> shipped;
  for (const char* folder : {"../share/qwsm/scenarios", "../../../configs/scenarios"}) {
    for (const auto& entry : fs::directory_iterator(program / folder, error)) {
      if (entry.path().extension() != ".yaml") continue;
      shipped.try_emplace(entry.path().stem().string(), fs::weakly_canonical(entry.path(), error));
    }
  }
  return shipped;
}

}  // namespace

fs::path FindScenario(const std::string& path_or_name) {
  std::error_code error;
  const bool is_name = path_or_name.find_first_of("/.") == std::string::npos;
  // A folder of that name holds results, more likely than not.
  if (!is_name || fs::is_regular_file(path_or_name, error)) return path_or_name;
  const std::map<std::string, fs::path> shipped = ShippedScenarios();
  if (const auto found = shipped.find(path_or_name); found != shipped.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, file] : shipped) names.push_back(name);
  Problem unknown;
  unknown.location.source = path_or_name;
  unknown.what = fmt::format(
      "is no file and no scenario ({}){}", fmt::join(names, ", "), DidYouMean(path_or_name, names));
  throw ConfigError({unknown});
}

}  // namespace qwsm::config
