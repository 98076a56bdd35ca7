// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/scenario_file.hpp"

#include <system_error>

namespace qwsm::config {

namespace fs = std::filesystem;

fs::path FindScenario(const std::string& path_or_name) {
  std::error_code error;
  const bool is_name = path_or_name.find_first_of("/.") == std::string::npos;
  // A folder of that name holds results, more likely than not.
  if (!is_name || fs::is_regular_file(path_or_name, error)) return path_or_name;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* folder : {"../share/qwsm/scenarios", "../../../configs/scenarios"}) {
    const fs::path file = program / folder / (path_or_name + ".yaml");
    if (fs::exists(file, error)) return fs::weakly_canonical(file, error);
  }
  return path_or_name;
}

}  // namespace qwsm::config
