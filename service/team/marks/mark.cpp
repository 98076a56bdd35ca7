// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/marks/mark.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace qwsm::team {
namespace {

constexpr std::size_t kLongestId = 64;
constexpr std::size_t kLongestText = 1024;
constexpr double kFarthestMark_m = 1e6;

// Whatever is not a number is not below.
bool IsWithin(const Eigen::Vector2d& p_m) { return p_m.norm() < kFarthestMark_m; }

}  // namespace

std::string_view ObjectionTo(const Mark& mark) {
  constexpr std::array<std::string_view, 3> kKinds{"victim", "hazard", "note"};
  if (mark.id.empty() || mark.id.size() > kLongestId) return "its id is empty or too long";
  if (std::ranges::find(kKinds, mark.kind) == kKinds.end()) {
    return "its kind is neither victim nor hazard nor note";
  }
  if (std::max(mark.text.size(), mark.author.size()) > kLongestText) return "its text is too long";
  if (!IsWithin(mark.p_map_m)) return "it lies nowhere";
  if (!mark.anchor) return {};
  if (mark.anchor->robot.size() > kLongestText) return "the name of its robot is too long";
  return IsWithin(mark.anchor->p_robot_m) ? std::string_view() : "it lies nowhere";
}

bool Supersedes(const Mark& mark, const Mark& known) {
  return std::tie(mark.stamp, mark.revision) > std::tie(known.stamp, known.revision);
}

}  // namespace qwsm::team
