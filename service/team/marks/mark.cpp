// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/marks/mark.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace qwsm::team {
namespace {

constexpr std::size_t kLongestId = 64;
constexpr std::size_t kLongestText = 1024;
constexpr double kFarthestMark_m = 1e6;
constexpr std::uint32_t kHighestNumber = 999'999;  // People say them.

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
  if (mark.number > kHighestNumber) return "its number is too high";
  if (!IsWithin(mark.p_map_m)) return "it lies nowhere";
  if (!mark.anchor) return {};
  if (mark.anchor->robot.size() > kLongestText) return "the name of its robot is too long";
  return IsWithin(mark.anchor->p_robot_m) ? std::string_view() : "it lies nowhere";
}

bool Supersedes(const Mark& mark, const Mark& known) {
  return std::tie(mark.stamp, mark.revision, mark.number) >
         std::tie(known.stamp, known.revision, known.number);
}

// The numbers of marks that were removed are not given again while there are others: people
// remember them.
std::uint32_t NumberAfter(const std::set<std::uint32_t>& given) {
  const std::uint32_t last = given.empty() ? 0 : *given.rbegin();
  if (last < kHighestNumber) return last + 1;
  std::uint32_t free = 1;
  while (given.contains(free)) ++free;
  return free;
}

std::vector<Mark> NumberApart(std::span<Mark> marks) {
  std::set<std::uint32_t> given;
  std::vector<Mark*> there;
  for (Mark& mark : marks) {
    given.insert(mark.number);
    if (!mark.is_removed) there.push_back(&mark);
  }
  std::ranges::sort(there, {}, [](const Mark* mark) { return std::tie(mark->stamp, mark->id); });
  std::set<std::uint32_t> taken{0};
  std::vector<Mark> renumbered;
  for (Mark* mark : there) {
    if (taken.insert(mark->number).second) continue;
    mark->number = NumberAfter(given);
    given.insert(mark->number);
    ++mark->revision;
    renumbered.push_back(*mark);
  }
  return renumbered;
}

std::vector<Mark> Merged(std::span<const Mark> marks) {
  std::map<std::string_view, Mark> newest;
  for (const Mark& mark : marks) {
    const auto [known, is_new] = newest.try_emplace(mark.id, mark);
    if (!is_new && Supersedes(mark, known->second)) known->second = mark;
  }
  std::vector<Mark> merged;
  for (auto& [id, mark] : newest) merged.push_back(std::move(mark));
  NumberApart(merged);
  return merged;
}

}  // namespace qwsm::team
