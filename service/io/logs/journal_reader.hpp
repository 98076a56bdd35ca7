// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/journal/journal_file.hpp"

namespace qwsm::io {

/// Reads the journal of a service as a log of its relevant scans.
///
/// Their poses in the map, as it was corrected last, stand for odometry: those of all robots of a
/// team are in one frame, so that the scans of several robots can be read as one drive.
class JournalReader final : public LogReader {
 public:
  /// Opens a journal. @param mirrored see LogOptions.
  /// @throws LogError where it is no journal of planar scans.
  explicit JournalReader(const std::filesystem::path& file, bool mirrored = false);

  std::optional<LogRecord> Next() override;
  const LogReport& report() const override { return report_; }
  /// Progress in entries, not in bytes.
  LogProgress progress() const override;

 private:
  std::optional<JournalEntry> NextEntry();
  void Count(std::size_t entries, const char* what);

  using Key = std::tuple<std::string, std::string, std::uint64_t>;  // Service, robot, sequence.

  void ReadCorrections(const std::filesystem::path& file);

  JournalFile journal_;
  // Scans that are not where they were taken: the component of the map, and the pose in it.
  std::map<Key, std::pair<std::string, UncertainPose2>> corrected_;
  LogReport report_;
  std::size_t entries_;
  bool mirrored_;
};

}  // namespace qwsm::io
