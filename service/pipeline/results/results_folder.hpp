// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "service/pipeline/results/result_file.hpp"

namespace qwsm::pipeline {

/// A folder that takes the results of one run.
class ResultsFolder {
 public:
  /// Creates the folder. One that exists must be empty or hold results of an earlier run; with
  /// `force`, any folder will do. Files that have the names of results are removed first, so that
  /// nothing of an earlier run is mistaken for this one's; whatever else is there stays.
  /// @param inputs files, or folders of files, that the run reads or goes on with; "-" is none.
  /// @throws io::WriteError where that is not so, where the folder holds an input, or where it
  ///         cannot be written to.
  ResultsFolder(std::filesystem::path folder,
                bool force,
                std::span<const std::filesystem::path> inputs = {});

  /// Creates the folder `results/<UTC time>/`, with a link `results/latest` to it.
  static ResultsFolder ForNow(const std::filesystem::path& parent);

  /// Throws what the constructor would object to. @throws io::WriteError.
  static void Check(const std::filesystem::path& folder,
                    bool force,
                    std::span<const std::filesystem::path> inputs = {});

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path operator/(std::string_view name) const { return folder_ / name; }
  std::filesystem::path operator/(ResultFile file) const { return folder_ / file; }

 private:
  std::filesystem::path folder_;
};

}  // namespace qwsm::pipeline
