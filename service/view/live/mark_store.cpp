// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/live/mark_store.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/view/protocol/told_mark.hpp"

namespace qwsm::view {
namespace {

using MarkJson = nlohmann::json;

MarkJson ToJson(const dds::Mark& mark) {
  return {{"stamp_ns", mark.stamp.count()},
          {"frame", mark.frame},
          {"id", mark.id},
          {"kind", mark.kind},
          {"text", mark.text},
          {"author", mark.author},
          {"x_m", mark.x_m},
          {"y_m", mark.y_m},
          {"removed", mark.is_removed}};
}

/// @throws MarkJson::exception where it is no mark.
dds::Mark FromJson(const MarkJson& json) {
  return {.stamp = Timestamp(json.at("stamp_ns").get<std::int64_t>()),
          .frame = json.at("frame"),
          .id = json.at("id"),
          .kind = json.at("kind"),
          .text = json.at("text"),
          .author = json.at("author"),
          .x_m = json.at("x_m"),
          .y_m = json.at("y_m"),
          .is_removed = json.at("removed")};
}

}  // namespace

MarkStore::MarkStore(std::filesystem::path file, Warn warn)
    : file_(std::move(file)), warn_(std::move(warn)) {
  std::error_code ignored;
  if (!file_.empty() && std::filesystem::exists(file_, ignored)) Load();
}

void MarkStore::Load() {
  try {
    std::ifstream stream(file_);
    for (const MarkJson& json : MarkJson::parse(stream)) {
      const dds::Mark mark = FromJson(json);
      if (ObjectionTo(mark).empty()) marks_.insert_or_assign(mark.id, mark);
    }
  } catch (const MarkJson::exception& error) {
    std::filesystem::path aside = file_;
    aside += ".damaged";
    std::error_code ignored;
    std::filesystem::rename(file_, aside, ignored);
    warn_(fmt::format("{}: the marks cannot be read: {}; it is {} now",
                      file_.string(),
                      error.what(),
                      aside.string()));
  }
}

bool MarkStore::HasRoomFor(const dds::Mark& mark) const {
  return marks_.size() < kMostMarks || marks_.contains(mark.id);
}

void MarkStore::Take(const dds::Mark& mark) {
  if (!HasRoomFor(mark)) return;
  const auto [known, is_new] = marks_.try_emplace(mark.id, mark);
  if (!is_new && mark.stamp <= known->second.stamp) return;
  known->second = mark;
  Save();
}

std::vector<dds::Mark> MarkStore::marks() const {
  std::vector<dds::Mark> marks;
  for (const auto& [id, mark] : marks_) marks.push_back(mark);
  return marks;
}

void MarkStore::Save() const {
  if (file_.empty()) return;
  MarkJson list = MarkJson::array();
  for (const auto& [id, mark] : marks_) list.push_back(ToJson(mark));
  try {
    io::WriteTextFile(file_, list.dump(1, ' ', false, MarkJson::error_handler_t::replace) + "\n");
  } catch (const io::WriteError& error) {
    warn_(fmt::format("the marks are not kept: {}", error.what()));
  }
}

}  // namespace qwsm::view
