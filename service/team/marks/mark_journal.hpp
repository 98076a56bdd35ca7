// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/marks/mark.hpp"

namespace qwsm::team {

/// The bytes of a mark for a journal.
std::string EncodeMark(const Mark& mark);
/// The mark of bytes of a journal. @throws io::BinaryError where they are none.
Mark DecodeMark(std::string_view bytes);

/// Reads the marks of a journal; it may be in use. @param damaged counts those that are lost.
/// @throws io::JournalError where it is no journal.
std::vector<Mark> ReadMarks(const std::filesystem::path& journal, std::size_t& damaged);

/// Keeps marks in the journal of a service, beside its scans. What cannot be written now is written
/// when it is next asked to keep something, or nothing.
class MarkJournal {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Writes nothing yet. @param file of the service's journal; empty: marks are not kept.
  MarkJournal(std::filesystem::path file, Warn warn);

  /// The marks that were kept. What is damaged is warned of and left out.
  std::vector<Mark> Load() const;
  /// Keeps marks; waits for the disk.
  void Keep(const std::vector<Mark>& marks);
  /// Whether there are marks that could not be written.
  bool is_behind() const { return !unwritten_.empty(); }

 private:
  std::filesystem::path file_;
  Warn warn_;
  std::map<std::string, Mark> unwritten_;  // By their ids.
};

}  // namespace qwsm::team
