// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/protocol/told_mark.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>

#include "service/io/bags/messages/message_reader.hpp"

namespace qwsm::view {
namespace {

constexpr std::size_t kLongestId = 64;
constexpr std::size_t kLongestText = 1024;
constexpr double kFarthestMark_m = 1e6;

}  // namespace

dds::Mark DecodeMark(std::string_view cdr) {
  io::MessageReader reader(cdr, io::Encoding::kCdr);
  dds::Mark mark;
  const auto seconds = static_cast<std::int32_t>(reader.Unsigned32());
  mark.stamp = std::chrono::seconds(seconds) + std::chrono::nanoseconds(reader.Unsigned32());
  mark.frame = reader.String();
  mark.id = reader.String();
  mark.kind = reader.String();
  mark.text = reader.String();
  mark.author = reader.String();
  mark.x_m = reader.Double();
  mark.y_m = reader.Double();
  mark.is_removed = reader.Byte() != 0;
  if (const auto objection = ObjectionTo(mark); !objection.empty()) {
    throw io::MessageError(std::string(objection));
  }
  return mark;
}

std::string_view ObjectionTo(const dds::Mark& mark) {
  constexpr std::array<std::string_view, 3> kKinds{"victim", "hazard", "note"};
  if (mark.id.empty() || mark.id.size() > kLongestId) return "its id is empty or too long";
  if (std::ranges::find(kKinds, mark.kind) == kKinds.end()) {
    return "its kind is neither victim nor hazard nor note";
  }
  if (std::max(mark.text.size(), mark.author.size()) > kLongestText) return "its text is too long";
  if (!(std::hypot(mark.x_m, mark.y_m) < kFarthestMark_m)) return "it lies nowhere";
  return {};
}

}  // namespace qwsm::view
