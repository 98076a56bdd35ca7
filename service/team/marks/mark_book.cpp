// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/marks/mark_book.hpp"

#include <limits>
#include <set>
#include <utility>

namespace qwsm::team {
namespace {

// Below, nobody sees that a mark has moved.
constexpr double kLeastMove_m = 1e-3;

using ScanName = std::pair<std::string, Timestamp>;

}  // namespace

bool MarkBook::HasRoomFor(const Mark& mark) const {
  if (marks_.size() < kMostMarks || marks_.contains(mark.id)) return true;
  return !mark.is_removed && OldestRemoved() != marks_.end();
}

const Mark* MarkBook::Find(const std::string& id) const {
  const auto known = marks_.find(id);
  return known == marks_.end() ? nullptr : &known->second;
}

std::map<std::string, Mark>::const_iterator MarkBook::OldestRemoved() const {
  auto oldest = marks_.end();
  for (auto mark = marks_.begin(); mark != marks_.end(); ++mark) {
    if (!mark->second.is_removed) continue;
    if (oldest == marks_.end() || mark->second.stamp < oldest->second.stamp) oldest = mark;
  }
  return oldest;
}

bool MarkBook::Take(const Mark& mark) {
  if (!HasRoomFor(mark)) return false;
  if (marks_.size() >= kMostMarks && !marks_.contains(mark.id)) marks_.erase(OldestRemoved());
  const auto [known, is_new] = marks_.try_emplace(mark.id, mark);
  if (!is_new && !Supersedes(mark, known->second)) return false;
  known->second = mark;
  return true;
}

Mark MarkBook::Completed(Mark mark) const {
  const auto known = marks_.find(mark.id);
  if (known != marks_.end()) mark.number = known->second.number;
  if (mark.number == 0) {
    std::set<std::uint32_t> given;
    for (const auto& [id, other] : marks_) given.insert(other.number);
    mark.number = NumberAfter(given);
  }
  mark.anchor.reset();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& [robot, scans] : places_) {
    for (const auto& [stamp, T_map_robot] : scans) {
      const double distance_m = (T_map_robot.translation_m() - mark.p_map_m).norm();
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      mark.anchor = {
          .robot = robot, .stamp = stamp, .p_robot_m = T_map_robot.Inverse() * mark.p_map_m};
    }
  }
  return mark;
}

// Who hears a mark does not move it, only who learns of a scan: services that do not agree on where
// a scan is would else go on for ever.
std::vector<Mark> MarkBook::Place(std::span<const ScanPlace> places) {
  std::map<ScanName, Pose2> news;
  for (const ScanPlace& place : places) {
    news.insert_or_assign({place.robot, place.stamp}, place.T_map_robot);
    places_[place.robot][place.stamp] = place.T_map_robot;
  }
  std::vector<Mark> moved;
  for (auto& [id, mark] : marks_) {
    if (!mark.anchor) continue;
    const auto scan = news.find({mark.anchor->robot, mark.anchor->stamp});
    if (scan == news.end()) continue;
    const Eigen::Vector2d p_map_m = scan->second * mark.anchor->p_robot_m;
    if ((p_map_m - mark.p_map_m).norm() < kLeastMove_m) continue;
    mark.p_map_m = p_map_m;
    ++mark.revision;
    moved.push_back(mark);
  }
  return moved;
}

std::vector<Mark> MarkBook::NumberApart() {
  std::vector<Mark> all = marks();
  std::vector<Mark> renumbered = team::NumberApart(all);
  for (const Mark& mark : renumbered) marks_[mark.id] = mark;
  return renumbered;
}

std::vector<Mark> MarkBook::marks() const {
  std::vector<Mark> marks;
  for (const auto& [id, mark] : marks_) marks.push_back(mark);
  return marks;
}

std::vector<Mark> PlacedOn(std::span<const ScanPlace> places, std::span<const Mark> marks) {
  MarkBook book;
  for (const Mark& mark : marks) book.Take(mark);
  book.Place(places);
  return book.marks();
}

}  // namespace qwsm::team
