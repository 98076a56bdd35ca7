// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/mark_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "service/dds/wire/mark_conversion.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::dds {
namespace {

constexpr std::chrono::seconds kBetweenTries{1};

}  // namespace

MarkExchange::MarkExchange(const Participant& participant,
                           Refusals& refusals,
                           team::MarkJournal journal)
    : refusals_(refusals),
      map_frame_(kMapFrame),
      wait_set_(participant),
      reader_(participant, kMarksTopic, Profile::kMarks),
      scans_(participant, kSharedScansTopic, Profile::kSharedScansIn),
      writer_(participant, kMarksTopic, Profile::kMarks),
      journal_(std::move(journal)) {
  wait_set_.Add(reader_.handle());
  wait_set_.Add(scans_.handle());
}

MarkExchange::~MarkExchange() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  wait_set_.Wake();
  thread_.join();
}

void MarkExchange::Start() {
  for (const team::Mark& mark : journal_.Load()) book_.Take(mark);
  unkept_ = book_.NumberApart();
  for (const team::Mark& mark : book_.marks()) writer_.Write(ToWire(mark, map_frame_));
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

void MarkExchange::Tell(team::Mark mark) {
  mark.stamp = std::chrono::system_clock::now().time_since_epoch();
  mark.revision = 0;
  const std::lock_guard lock(mutex_);
  // Who made it may have had a clock that is ahead of this one.
  if (const team::Mark* known = book_.Find(mark.id); known && known->stamp >= mark.stamp) {
    mark.stamp = known->stamp;
    mark.revision = known->revision + 1;
  }
  mark = book_.Completed(std::move(mark));
  if (const auto objection = team::ObjectionTo(mark); !objection.empty()) {
    throw MarkError(std::string(objection));
  }
  if (!book_.HasRoomFor(mark)) throw MarkError("there are too many marks");
  if (!book_.Take(mark)) throw MarkError("what is known of it is newer");
  TellAndKeep({mark});
}

void MarkExchange::Place(std::span<const team::ScanPlace> places) {
  const std::lock_guard lock(mutex_);
  TellAndKeep(book_.Place(places));
}

std::vector<team::Mark> MarkExchange::marks() const {
  const std::lock_guard lock(mutex_);
  return book_.marks();
}

/// @pre the mutex is held.
void MarkExchange::TellAndKeep(const std::vector<team::Mark>& marks) {
  if (marks.empty()) return;
  for (const team::Mark& mark : marks) writer_.Write(ToWire(mark, map_frame_));
  // The writer keeps the last samples for late comers: among these must be one of every mark.
  told_ += marks.size();
  if (told_ + book_.marks().size() > team::MarkBook::kMostMarks) {
    for (const team::Mark& mark : book_.marks()) writer_.Write(ToWire(mark, map_frame_));
    told_ = 0;
  }
  unkept_.insert(unkept_.end(), marks.begin(), marks.end());
  wait_set_.Wake();
}

void MarkExchange::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    wait_set_.Wait(std::chrono::seconds(1));
    HearScans();
    HearMarks();
    Keep();
  }
}

// What this service has told comes back, too, and is no news.
void MarkExchange::HearMarks() {
  std::vector<team::Mark> news;
  const std::lock_guard lock(mutex_);
  reader_.TakeAll([&](const wire::Mark& sample) {
    const std::string_view objection = ObjectionTo(sample);
    if (!objection.empty()) return refusals_.Add(kMarksTopic, objection);
    const team::Mark mark = FromWire(sample);
    if (book_.Take(mark)) news.push_back(mark);
  });
  if (news.empty()) return;
  std::ranges::move(book_.NumberApart(), std::back_inserter(news));
  TellAndKeep(news);
}

// What is told of a scan may be older than the last correction.
void MarkExchange::HearScans() {
  std::vector<team::ScanPlace> places;
  const std::lock_guard lock(mutex_);
  scans_.TakeAll([&](const wire::RelevantScan& sample) {
    // Refused samples are told by whoever makes a map of them.
    if (!ObjectionTo(sample).empty()) return;
    const Timestamp stamp = *FromWire(sample.header.stamp);
    const team::ScanKey key{
        .service = sample.origin, .robot = sample.robot, .sequence = sample.sequence_number};
    stamps_[key] = stamp;
    const auto corrected = corrected_.find(key);
    const bool is_in_map = team::ComponentOf(sample.header.frame_id).empty();
    if (corrected == corrected_.end() && !is_in_map) return;
    places.push_back(
        {.robot = key.robot,
         .stamp = stamp,
         .T_map_robot = corrected == corrected_.end() ? FromWire(sample.pose) : corrected->second});
  });
  TellAndKeep(book_.Place(places));
}

void MarkExchange::Follow(const team::TeamEpoch& epoch) {
  std::vector<team::ScanPlace> places;
  const std::lock_guard lock(mutex_);
  for (const team::MovedScan& scan : epoch.scans) {
    if (!scan.component.empty()) continue;  // Marks are in the map that all share.
    corrected_[scan.key] = scan.map_robot.T_a_b;
    const auto stamp = stamps_.find(scan.key);
    if (stamp == stamps_.end()) continue;
    places.push_back(
        {.robot = scan.key.robot, .stamp = stamp->second, .T_map_robot = scan.map_robot.T_a_b});
  }
  TellAndKeep(book_.Place(places));
}

void MarkExchange::Keep() {
  std::vector<team::Mark> marks;
  {
    const std::lock_guard lock(mutex_);
    marks.swap(unkept_);
  }
  // What could not be written is tried again also if nothing comes any more, but not with each
  // scan.
  const auto now = std::chrono::steady_clock::now();
  if (marks.empty() && (!journal_.is_behind() || now - tried_ < kBetweenTries)) return;
  tried_ = now;
  journal_.Keep(marks);
}

}  // namespace qwsm::dds
