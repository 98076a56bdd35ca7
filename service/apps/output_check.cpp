// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/output_check.hpp"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/map_file.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;

io::WriteError CannotTake(const fs::path& output, const std::string& why) {
  return io::WriteError(output.string() + ": " + why);
}

fs::path FolderOf(const fs::path& file) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(file, error), error).parent_path();
}

/// Whether it is the same file or folder, or one is a folder that holds the other.
bool WouldReplace(const fs::path& output, const fs::path& input) {
  std::error_code error;
  if (!fs::exists(output, error)) return false;
  return fs::equivalent(output, input, error) ||
         (fs::is_directory(output, error) && fs::equivalent(output, FolderOf(input), error)) ||
         (fs::is_directory(input, error) && fs::equivalent(input, FolderOf(output), error));
}

bool IsFolder(const fs::path& folder, const fs::path& wanted) {
  // As the folder of a file in it, which needs no part of its path to exist.
  return FolderOf(folder / "file") == FolderOf(wanted / "file");
}

}  // namespace

void RefuseToReplace(const fs::path& output, std::span<const fs::path> inputs) {
  if (output == "-") return;
  if (output.empty()) throw io::WriteError("--output: is empty; name a file");
  for (const fs::path& input : inputs) {
    if (input == "-" || !WouldReplace(output, input)) continue;
    throw CannotTake(output,
                     "would replace " + input.string() + ", which is an input; name another one");
  }
}

void CheckMapToSave(const fs::path& map, std::span<const fs::path> logs, const fs::path& results) {
  std::error_code error;
  if (map.empty()) throw io::WriteError("--save-map: is empty; name a file for the map");
  if (fs::is_directory(map, error)) {
    throw CannotTake(map, "is a folder; name a file for the map");
  }
  RefuseToReplace(map, logs);
  if (fs::exists(map, error) && !io::IsMap(map)) {
    throw CannotTake(map, "is no map of qwsm, and is not replaced by one; name another file");
  }
  const fs::path folder = FolderOf(map);
  if (!fs::exists(folder, error) && IsFolder(folder, results)) return;
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw CannotTake(map, "cannot be written: " + std::generic_category().message(errno));
  }
}

}  // namespace qwsm::apps
