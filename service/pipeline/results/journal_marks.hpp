// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "qwsm/metrics/stamped_pose.hpp"
#include "service/pipeline/run/step_sink.hpp"
#include "service/team/marks/mark_book.hpp"

namespace qwsm::pipeline {

/// The marks of a journal, with the places of its scans as it keeps them.
struct MarksOnScans {
  std::vector<team::Mark> marks;
  std::vector<team::ScanPlace> scans;  ///< In the order of the journal.
};

/// Reads them; of a file that is no journal of planar scans there are none. Warns of what is
/// damaged. @throws std::runtime_error where the journal cannot be read.
MarksOnScans ReadMarksOnScans(const std::filesystem::path& file);

/// Where the marks of journals are on a map that is made of the journals anew, beside those that
/// the map had before.
class JournalMarks final : public StepSink {
 public:
  /// Reads the marks of those logs that are journals.
  /// @param on_map of the map that the run begins with, where they are.
  explicit JournalMarks(std::span<const std::filesystem::path> logs,
                        const std::vector<team::Mark>& on_map = {});

  void Take(const TimedStep& timed) override;
  /// The marks on the map. @param map_robot poses of all steps once corrected; empty: as answered.
  std::vector<team::Mark> Placed(std::span<const UncertainPose2> map_robot) const;

 private:
  MarksOnScans kept_;
  std::vector<StampedPose2> answers_;
};

}  // namespace qwsm::pipeline
