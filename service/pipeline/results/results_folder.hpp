// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace qwsm::pipeline {

/// A folder that takes the results of one run.
class ResultsFolder {
 public:
  /// Creates the folder. One that exists must be empty or hold results of an earlier run, whose
  /// files are removed first so that nothing of it is mistaken for this one's; with `force`, any
  /// folder will do and what is not overwritten stays.
  /// @throws io::WriteError where that is not so, or the folder cannot be written to.
  ResultsFolder(std::filesystem::path folder, bool force);

  /// The same in `results/<UTC time>/`, with a link `results/latest` to it.
  static ResultsFolder ForNow(const std::filesystem::path& parent);

  /// What the constructor would object to. @throws io::WriteError.
  static void Check(const std::filesystem::path& folder, bool force);

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path operator/(std::string_view name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace qwsm::pipeline
