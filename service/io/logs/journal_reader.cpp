// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/journal_reader.hpp"

#include <tuple>
#include <utility>

#include "service/io/journal/epoch_codec.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/logs/sweep_geometry.hpp"

namespace qwsm::io {
namespace {

JournalFile Open(const std::filesystem::path& file) {
  try {
    return JournalFile::Read(file, kScanJournal);
  } catch (const JournalError& error) {
    throw LogError(error.what());
  }
}

}  // namespace

JournalReader::JournalReader(const std::filesystem::path& file, bool mirrored)
    : journal_(Open(file)), entries_(journal_.size()), mirrored_(mirrored) {
  report_.name = file.string();
  report_.format = "journal";
  report_.line_name = "entries";
  report_.compression = "none";
  ReadCorrections(file);
}

void JournalReader::ReadCorrections(const std::filesystem::path& file) {
  JournalFile journal = Open(file);
  while (const std::optional<JournalEntry> entry = journal.Next()) {
    if (!IsEpoch(entry->contents)) continue;
    try {
      for (const JournaledPose& pose : DecodeEpoch(entry->contents)) {
        corrected_[{pose.service, pose.robot, pose.sequence}] = {pose.component, pose.map_robot};
      }
    } catch (const BinaryError&) {
      Count(1, "an entry holds no correction that can be read");
    }
  }
}

std::optional<LogRecord> JournalReader::Next() {
  while (std::optional<JournalEntry> entry = NextEntry()) {
    if (IsEpoch(entry->contents)) continue;
    try {
      auto [relevant, T_odom_robot, component] = DecodeScan(entry->contents);
      const auto corrected = corrected_.find({entry->service, entry->robot, entry->sequence});
      if (corrected != corrected_.end())
        std::tie(component, relevant.map_robot) = corrected->second;
      if (!component.empty()) {
        Count(1, "a scan is in a map of its robot's own: nobody knows where in the team's it lies");
        continue;
      }
      ++report_.scans;
      if (mirrored_) Mirror(relevant.scan.geometry);
      return ScanReading{.scan = std::move(relevant.scan),
                         .T_odom_robot = relevant.map_robot.T_a_b,
                         .laser = std::move(entry->robot)};
    } catch (const BinaryError&) {
      Count(1, "an entry holds no scan that can be read");
    }
  }
  return std::nullopt;
}

std::optional<JournalEntry> JournalReader::NextEntry() {
  const std::size_t damaged_before = journal_.damaged();
  try {
    std::optional<JournalEntry> entry = journal_.Next();
    const std::size_t damaged = journal_.damaged() - damaged_before;
    report_.lines += damaged + (entry ? 1 : 0);
    if (damaged > 0) Count(damaged, "an entry is damaged");
    return entry;
  } catch (const JournalError& error) {
    throw LogError(error.what());
  }
}

void JournalReader::Count(std::size_t entries, const char* what) {
  for (LogFault& fault : report_.faults) {
    if (fault.what != what) continue;
    fault.count += entries;
    return;
  }
  report_.faults.push_back({.what = what, .count = entries, .first_line = report_.lines});
}

LogProgress JournalReader::progress() const {
  return {.bytes_read = report_.lines, .bytes_total = entries_};
}

}  // namespace qwsm::io
