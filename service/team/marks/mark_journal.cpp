// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/marks/mark_journal.hpp"

#include <stdexcept>
#include <utility>

#include "service/io/files/binary.hpp"
#include "service/io/journal/mark_table.hpp"

namespace qwsm::team {

std::string EncodeMark(const Mark& mark) {
  io::BinaryWriter writer;
  writer.Add(static_cast<std::int64_t>(mark.stamp.count()));
  writer.Add(mark.revision);
  writer.Add(mark.number);
  for (const std::string& text : {mark.id, mark.kind, mark.text, mark.author}) {
    writer.Add(std::string_view(text));
  }
  writer.Add(mark.p_map_m.x());
  writer.Add(mark.p_map_m.y());
  writer.Add(static_cast<std::uint8_t>(mark.is_removed ? 1 : 0));
  writer.Add(static_cast<std::uint8_t>(mark.anchor ? 1 : 0));
  if (!mark.anchor) return writer.bytes();
  writer.Add(std::string_view(mark.anchor->robot));
  writer.Add(static_cast<std::int64_t>(mark.anchor->stamp.count()));
  writer.Add(mark.anchor->p_robot_m.x());
  writer.Add(mark.anchor->p_robot_m.y());
  return writer.bytes();
}

Mark DecodeMark(std::string_view bytes) {
  io::BinaryReader reader(bytes);
  const auto take_point = [&reader] {
    const double x_m = reader.Double();
    return Eigen::Vector2d(x_m, reader.Double());
  };
  Mark mark;
  mark.stamp = Timestamp(reader.Signed64());
  mark.revision = reader.Unsigned64();
  mark.number = reader.Unsigned32();
  for (std::string* text : {&mark.id, &mark.kind, &mark.text, &mark.author}) *text = reader.Text();
  mark.p_map_m = take_point();
  mark.is_removed = reader.Unsigned8() != 0;
  if (reader.Unsigned8() != 0) {
    MarkAnchor& anchor = mark.anchor.emplace();
    anchor.robot = reader.Text();
    anchor.stamp = Timestamp(reader.Signed64());
    anchor.p_robot_m = take_point();
  }
  if (const auto objection = ObjectionTo(mark); !objection.empty()) {
    throw io::BinaryError(std::string(objection));
  }
  return mark;
}

std::vector<Mark> ReadMarks(const std::filesystem::path& journal, std::size_t& damaged) {
  std::vector<Mark> marks;
  for (const std::string& contents : io::ReadMarks(journal, damaged)) {
    try {
      marks.push_back(DecodeMark(contents));
    } catch (const io::BinaryError&) {
      ++damaged;
    }
  }
  return marks;
}

MarkJournal::MarkJournal(std::filesystem::path file, Warn warn)
    : file_(std::move(file)), warn_(std::move(warn)) {}

std::vector<Mark> MarkJournal::Load() const {
  std::error_code ignored;
  if (file_.empty() || !std::filesystem::exists(file_, ignored)) return {};
  try {
    std::size_t damaged = 0;
    std::vector<Mark> marks = ReadMarks(file_, damaged);
    if (damaged > 0) {
      warn_(file_.string() + ": " + std::to_string(damaged) + " marks are damaged and left out");
    }
    return marks;
  } catch (const std::runtime_error& error) {
    warn_(std::string("the marks cannot be read: ") + error.what());
    return {};
  }
}

void MarkJournal::Keep(const std::vector<Mark>& marks) {
  if (file_.empty()) return;
  const bool had_trouble = !unwritten_.empty();
  for (const Mark& mark : marks) unwritten_.insert_or_assign(mark.id, mark);
  std::vector<io::KeptMark> kept;
  for (const auto& [id, mark] : unwritten_) {
    kept.push_back({.id = id, .contents = EncodeMark(mark)});
  }
  try {
    io::KeepMarks(file_, kept);
    unwritten_.clear();
  } catch (const std::runtime_error& error) {
    if (!had_trouble) warn_(std::string("marks cannot be kept now: ") + error.what());
  }
}

}  // namespace qwsm::team
