// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "service/pipeline/results/result_file.hpp"

namespace qwsm::pipeline {

/// A folder that takes the results of one run.
class ResultsFolder {
 public:
  /// Creates the folder. One that exists must be empty or hold results of an earlier run; with
  /// `force`, any folder will do. Files that have the names of results are removed first, there and
  /// in the parts of the earlier run, so that nothing of it is mistaken for this one's; whatever
  /// else is there stays, such as results of other runs in folders of their own.
  /// @param inputs files, or folders of files, that the run reads or goes on with; "-" is none.
  /// @throws io::WriteError where that is not so, where the folder holds an input, or where it
  ///         cannot be written to.
  ResultsFolder(std::filesystem::path folder,
                bool force,
                std::span<const std::filesystem::path> inputs = {});

  /// Creates the folder `results/<UTC time>/`, with a link `results/latest` to it.
  static ResultsFolder ForNow(const std::filesystem::path& parent);

  /// A folder in it for a part of the run, such as a robot: it goes with the run's results. One
  /// that exists is taken as the constructor takes it. May be called from any thread.
  /// @param name of the folder; empty for what has no folder of its own.
  /// @throws io::WriteError as the constructor does.
  ResultsFolder Part(const std::string& name,
                     bool force,
                     std::span<const std::filesystem::path> inputs = {}) const;

  /// Throws what the constructor would object to. @throws io::WriteError.
  static void Check(const std::filesystem::path& folder,
                    bool force,
                    std::span<const std::filesystem::path> inputs = {});

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path operator/(std::string_view name) const { return folder_ / name; }
  std::filesystem::path operator/(ResultFile file) const { return folder_ / file; }

 private:
  explicit ResultsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Creates the folder, or takes one that exists, and removes what an earlier run left there.
  void Begin(bool force, std::span<const std::filesystem::path> inputs) const;

  std::filesystem::path folder_;
};

}  // namespace qwsm::pipeline
