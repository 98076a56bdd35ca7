// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Writes the pose of the robot in the map at every scan, in their order, as a TUM trajectory.
class TrajectorySink final : public StepSink {
 public:
  explicit TrajectorySink(const std::filesystem::path& path) : file_(path) {}

  void Take(const TimedStep& timed) override;
  void Commit() { file_.Commit(); }
  /// See io::AtomicFile.
  const std::filesystem::path& KeepUnfinished() { return file_.KeepUnfinished(); }

 private:
  io::AtomicFile file_;
};

}  // namespace qwsm::pipeline
