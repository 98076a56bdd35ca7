// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/marks_of_map.hpp"

#include <string>

#include "service/io/files/binary.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/marks/mark_journal.hpp"

namespace qwsm::pipeline {

void SaveMap(const std::filesystem::path& path,
             const ScanMap& map,
             std::span<const team::Mark> marks) {
  std::vector<std::string> encoded;
  for (const team::Mark& mark : team::Merged(marks)) encoded.push_back(team::EncodeMark(mark));
  io::SaveMap(path, map, encoded);
}

std::vector<team::Mark> MarksOfMap(const std::filesystem::path& path) {
  std::vector<team::Mark> marks;
  for (const std::string& bytes : io::LoadMarksOfMap(path)) {
    try {
      marks.push_back(team::DecodeMark(bytes));
    } catch (const io::BinaryError& error) {
      messages::Warn("{}: a mark is left out: {}", path.string(), error.what());
    }
  }
  return marks;
}

}  // namespace qwsm::pipeline
