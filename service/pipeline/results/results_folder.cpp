// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/results_folder.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <ctime>
#include <string>
#include <system_error>
#include <utility>

#include "service/io/files/atomic_file.hpp"

namespace qwsm::pipeline {
namespace {

namespace fs = std::filesystem;

// By it a folder of results is known; what it says is for people.
constexpr std::string_view kMarker = ".qwsm-results";

io::WriteError Refused(const fs::path& folder, const std::string& why) {
  return io::WriteError(folder.string() + ": " + why);
}

void ThrowIf(const std::error_code& error, const fs::path& path, std::string_view what) {
  if (error) throw Refused(path, fmt::format("cannot {}: {}", what, error.message()));
}

/// Ours are regular files and links to them; folders in a folder of results are somebody else's.
void RemoveFiles(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    fs::remove(entry.path(), error);
    ThrowIf(error, entry.path(), "be removed");
  }
  ThrowIf(error, folder, "be read");
}

/// Results among the inputs would be taken for inputs, and inputs among the results be removed with
/// them.
void RefuseInputsIn(const fs::path& folder, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    std::error_code error;
    if (input.empty() || input == "-") continue;
    const fs::path file = fs::absolute(input, error).lexically_normal();
    const fs::path parent = file.has_filename() ? file.parent_path() : file;
    if (!fs::equivalent(file, folder, error) && !fs::equivalent(parent, folder, error)) continue;
    throw Refused(folder,
                  fmt::format("holds {}, which is an input; name another folder for the results",
                              input.string()));
  }
}

std::string UtcTime() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H-%M-%SZ", &utc)};
}

void PointTo(const fs::path& link, const fs::path& target) {
  const fs::path temporary = link.string() + ".part";
  std::error_code error;
  fs::remove(temporary, error);
  fs::create_directory_symlink(target, temporary, error);
  ThrowIf(error, temporary, "be created");
  fs::rename(temporary, link, error);
  ThrowIf(error, link, "be created");
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path folder, bool force, std::span<const fs::path> inputs)
    : folder_(std::move(folder)) {
  Check(folder_, force, inputs);
  std::error_code error;
  fs::create_directories(folder_, error);
  ThrowIf(error, folder_, "be created");
  if (fs::exists(folder_ / kMarker) && !force) RemoveFiles(folder_);
  io::WriteTextFile(folder_ / kMarker, "Results of a run; the next run may replace them.\n");
}

ResultsFolder ResultsFolder::ForNow(const fs::path& parent) {
  const std::string time = UtcTime();
  std::string name = time;
  for (int count = 2; fs::exists(parent / name); ++count) name = fmt::format("{}-{}", time, count);
  ResultsFolder results(parent / name, false);
  PointTo(parent / "latest", name);
  return results;
}

void ResultsFolder::Check(const fs::path& folder, bool force, std::span<const fs::path> inputs) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw Refused(folder, "is a file; name a folder for the results");
  RefuseInputsIn(folder, inputs);
  const bool is_empty = fs::is_empty(folder, error);
  ThrowIf(error, folder, "be read");
  if (is_empty || force || fs::exists(folder / kMarker)) return;
  throw Refused(folder, "is not empty and no earlier result; --force writes into it all the same");
}

}  // namespace qwsm::pipeline
