// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/results_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/numbered_name.hpp"

namespace qwsm::pipeline {
namespace {

namespace fs = std::filesystem;

// By it a folder of results is known. A line for people, then one for each part of the run.
constexpr std::string_view kMarker = ".qwsm-results";
constexpr std::string_view kOfRun = "Results of a run; the next run may replace them.\n";
constexpr std::string_view kOfPart = "Part of a run's results; the next run may remove them.\n";
constexpr std::string_view kPart = "part ";

io::WriteError Refused(const fs::path& folder, const std::string& why) {
  return io::WriteError(folder.string() + ": " + why);
}

void ThrowIf(const std::error_code& error, const fs::path& path, std::string_view what) {
  if (error) throw Refused(path, fmt::format("cannot {}: {}", what, error.message()));
}

/// Whether a file is one of a series of scans in 3D: scan007.3d, its pose or its frames.
bool IsNumberedScan(const fs::path& name) {
  const io::NumberedName stem = io::NumberedName::Of(name.stem().string());
  const fs::path ending = name.extension();
  return stem.name == "scan" && stem.has_number &&
         (ending == ".3d" || ending == ".pose" || ending == ".frames");
}

/// Whether programs give files of results that name, when they are complete or before.
/// @param is_marked of the folder: `slam6d register` calls frames as the scans are called.
bool IsOfResults(fs::path name, bool is_marked) {
  if (name.extension() == ".part") name = name.stem();
  return IsResultFile(name.string()) || IsNumberedScan(name) ||
         (is_marked && name.extension() == ".frames");
}

std::string MarkingOf(const fs::path& folder) {
  std::ifstream marker(folder / kMarker, std::ios::binary);
  return {std::istreambuf_iterator<char>(marker), {}};
}

/// At once, for robots may begin at the same time; and without waiting for the disk, as a robot
/// does that is answered meanwhile.
/// @param mode std::ios::app to add to what it says.
void Mark(const fs::path& folder, const std::string& text, std::ios::openmode mode) {
  std::ofstream marker(folder / kMarker, std::ios::binary | mode);
  marker << text << std::flush;
  if (!marker) throw Refused(folder / kMarker, "cannot be written");
}

/// Whether a folder has a real one of that name in it, and no link to another.
bool HasFolder(const fs::path& folder, const fs::path& name) {
  fs::path path = folder;
  std::error_code error;
  return name.is_relative() && !name.empty() && std::ranges::all_of(name, [&](const auto& part) {
           path /= part;
           return part != "." && part != ".." &&
                  fs::symlink_status(path, error).type() == fs::file_type::directory;
         });
}

/// The parts that an earlier run has left in its folder. A copy of one that somebody keeps there is
/// none, nor is a folder that another run has had since.
std::vector<fs::path> PartsIn(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::istringstream marking(MarkingOf(folder));
  for (std::string line; std::getline(marking, line);) {
    if (!line.starts_with(kPart)) continue;
    const std::string name = line.substr(kPart.size());
    if (!HasFolder(folder, name) || !MarkingOf(folder / name).starts_with(kOfPart)) continue;
    parts.push_back(folder / name);
  }
  std::ranges::sort(parts, std::greater());  // What is in another one comes before that.
  return parts;
}

/// Whatever else is in the folder is somebody else's.
void RemoveFilesOfResults(const fs::path& folder) {
  std::error_code error;
  const bool is_marked = fs::exists(folder / kMarker, error);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const bool is_file = entry.symlink_status().type() == fs::file_type::regular;
    if (is_file && IsOfResults(entry.path().filename(), is_marked)) files.push_back(entry.path());
  }
  ThrowIf(error, folder, "be read");
  for (const fs::path& file : files) {
    fs::remove(file, error);
    ThrowIf(error, file, "be removed");
  }
}

void RemoveEarlierResults(const fs::path& folder) {
  for (const fs::path& part : PartsIn(folder)) {
    RemoveEarlierResults(part);
    std::error_code error;
    const auto left = std::distance(fs::directory_iterator(part, error), {});
    if (left > 1) continue;  // Something besides the marker.
    fs::remove(part / kMarker, error);
    fs::remove(part, error);
    ThrowIf(error, part, "be removed");
  }
  RemoveFilesOfResults(folder);
}

/// Whether a file is in a folder, or the folder itself, by its name or by what that links to.
bool IsIn(const fs::path& folder, const fs::path& input) {
  std::error_code error;
  for (const fs::path& file :
       {fs::absolute(input, error).lexically_normal(), fs::weakly_canonical(input, error)}) {
    const fs::path parent = file.has_filename() ? file.parent_path() : file;
    if (fs::equivalent(file, folder, error) || fs::equivalent(parent, folder, error)) return true;
  }
  return false;
}

/// Results among the inputs would be taken for inputs, and inputs among the results be removed with
/// them.
void RefuseInputsIn(const fs::path& folder, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    if (input.empty() || input == "-" || !IsIn(folder, input)) continue;
    throw Refused(folder,
                  fmt::format("holds {}, which is an input; name another folder for the results",
                              input.string()));
  }
  for (const fs::path& part : PartsIn(folder)) RefuseInputsIn(part, inputs);
}

std::string UtcTime() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H-%M-%SZ", &utc)};
}

/// @param target has a name that no other run's has.
void PointTo(const fs::path& link, const fs::path& target) {
  const fs::path temporary = link.string() + "." + target.string() + ".part";
  std::error_code error;
  fs::create_directory_symlink(target, temporary, error);
  ThrowIf(error, temporary, "be created");
  fs::rename(temporary, link, error);
  std::error_code ignored;
  if (error) fs::remove(temporary, ignored);
  ThrowIf(error, link, "be created");
}

/// Whether a folder was made that nobody had: runs may begin at the same time.
bool IsMade(const fs::path& folder) {
  std::error_code error;
  const bool is_made = fs::create_directory(folder, error);
  ThrowIf(error, folder, "be created");
  return is_made;
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path folder, bool force, std::span<const fs::path> inputs)
    : folder_(std::move(folder)) {
  Begin(force, inputs);
  io::WriteTextFile(folder_ / kMarker, kOfRun);
}

void ResultsFolder::Begin(bool force, std::span<const fs::path> inputs) const {
  Check(folder_, force, inputs);
  std::error_code error;
  fs::create_directories(folder_, error);
  ThrowIf(error, folder_, "be created");
  RemoveEarlierResults(folder_);
}

ResultsFolder ResultsFolder::Part(const std::string& name,
                                  bool force,
                                  std::span<const fs::path> inputs) const {
  if (name.empty()) return *this;
  ResultsFolder part(folder_ / name);
  part.Begin(force, inputs);
  Mark(part.folder_, std::string(kOfPart), std::ios::trunc);
  Mark(folder_, fmt::format("{}{}\n", kPart, name), std::ios::app);
  return part;
}

ResultsFolder ResultsFolder::ForNow(const fs::path& parent) {
  std::error_code error;
  fs::create_directories(parent, error);
  ThrowIf(error, parent, "be created");
  const std::string time = UtcTime();
  std::string name = time;
  for (int count = 2; !IsMade(parent / name); ++count) name = fmt::format("{}-{}", time, count);
  ResultsFolder results(parent / name, false);
  PointTo(parent / "latest", name);
  return results;
}

void ResultsFolder::Check(const fs::path& folder, bool force, std::span<const fs::path> inputs) {
  if (folder.empty()) throw io::WriteError("--output: is empty; name a folder for the results");
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
