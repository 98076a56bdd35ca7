// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// The uncertainty of a match that Visser et al. (2009, section 4.1) chart, in m^2: the sum of the
/// on-diagonal elements for x and y of its nearest_sample_covariance.
double PositionTrace_m2(const MatchResult& match);

/// Writes a table (CSV) of what the mapper found out about every scan. Columns are only ever added.
class ScanTableSink final : public StepSink {
 public:
  explicit ScanTableSink(const std::filesystem::path& path);

  void Take(const TimedStep& timed) override;
  void Commit() { file_.Commit(); }
  /// See io::AtomicFile.
  const std::filesystem::path& KeepUnfinished() { return file_.KeepUnfinished(); }

 private:
  io::AtomicFile file_;
};

/// Adds the corrected poses and their covariances to a table, as further columns.
/// @param corrected of every scan of the table; none where the corrected map has no place for it.
/// @throws io::WriteError.
void AddCorrectedPoses(const std::filesystem::path& table,
                       std::span<const std::optional<UncertainPose2>> corrected);

}  // namespace qwsm::pipeline
