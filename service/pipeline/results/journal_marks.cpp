// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/journal_marks.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

#include "service/io/journal/sqlite_database.hpp"
#include "service/io/logs/journal_reader.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/marks/mark_journal.hpp"

namespace qwsm::pipeline {

MarksOnScans ReadMarksOnScans(const std::filesystem::path& file) {
  MarksOnScans kept;
  std::optional<io::JournalReader> journal;
  try {
    if (io::IsSqliteDatabase(file)) journal.emplace(file);
  } catch (const io::LogError&) {
    return kept;  // A bag, or a journal of another kind of scans.
  }
  if (!journal) return kept;
  std::size_t damaged = 0;
  kept.marks = team::ReadMarks(file, damaged);
  if (damaged > 0) messages::Warn("{}: {} marks are damaged and left out", file.string(), damaged);
  if (kept.marks.empty()) return kept;
  while (std::optional<io::LogRecord> record = journal->Next()) {
    auto& reading = std::get<io::ScanReading>(*record);
    kept.scans.push_back({.robot = std::move(reading.laser),
                          .stamp = reading.scan.stamp,
                          .T_map_robot = reading.T_odom_robot.value_or(Pose2{})});
  }
  return kept;
}

JournalMarks::JournalMarks(std::span<const std::filesystem::path> logs,
                           const std::vector<team::Mark>& on_map)
    : kept_{.marks = on_map, .scans = {}} {
  for (const std::filesystem::path& log : logs) {
    MarksOnScans of_log = ReadMarksOnScans(log);
    std::ranges::move(of_log.marks, std::back_inserter(kept_.marks));
    std::ranges::move(of_log.scans, std::back_inserter(kept_.scans));
  }
}

void JournalMarks::Take(const TimedStep& timed) {
  if (kept_.marks.empty()) return;
  answers_.push_back({.stamp = timed.step.stamp, .T_map_robot = timed.step.map_robot.T_a_b});
}

std::vector<team::Mark> JournalMarks::Placed(std::span<const UncertainPose2> map_robot) const {
  // Robots of a team may scan at the same time: scans are told apart by their order, too.
  std::vector<team::ScanPlace> places;
  auto next = kept_.scans.begin();
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const auto scan =
        std::find_if(next, kept_.scans.end(), [stamp = answers_[i].stamp](const auto& kept) {
          return kept.stamp == stamp;
        });
    if (scan == kept_.scans.end()) continue;
    const Pose2 pose = i < map_robot.size() ? map_robot[i].T_a_b : answers_[i].T_map_robot;
    places.push_back({.robot = scan->robot, .stamp = scan->stamp, .T_map_robot = pose});
    next = std::next(scan);
  }
  return team::PlacedOn(places, kept_.marks);
}

}  // namespace qwsm::pipeline
