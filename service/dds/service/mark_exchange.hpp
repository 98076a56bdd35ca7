// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/wait_set.hpp"
#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/team/marks/mark_book.hpp"
#include "service/team/marks/mark_journal.hpp"
#include "service/team/scans/team_epoch.hpp"

namespace qwsm::dds {

/// Tells that a mark cannot be taken; the text says why.
class MarkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The marks of a team as one service knows them: hears those of all others and tells them again,
/// so that none is lost with whoever made it; keeps them in the journal, and moves them with the
/// scans that they stand on. In a thread of its own.
class MarkExchange {
 public:
  /// Hears and tells nothing yet.
  /// @param participant and refusals outlive this.
  /// @param journal keeps the marks.
  /// @throws DdsError.
  MarkExchange(const Participant& participant, Refusals& refusals, team::MarkJournal journal);
  MarkExchange(const MarkExchange&) = delete;
  MarkExchange& operator=(const MarkExchange&) = delete;
  ~MarkExchange();

  /// Tells what the journal holds, and begins. To be called once, when the service has opened it.
  void Start();

  // What follows any thread may call.

  /// Tells everybody what an operator has marked, changed or removed just now.
  /// @throws MarkError where it makes no sense, or there are too many.
  void Tell(team::Mark mark);
  /// Learns where scans are, and moves the marks on them. See team::MarkBook::Place().
  void Place(std::span<const team::ScanPlace> places);
  /// Moves the marks with the scans of a correction of the map.
  void Follow(const team::TeamEpoch& epoch);
  std::vector<team::Mark> marks() const;

 private:
  void Work(const std::stop_token& stop);
  void HearMarks();
  void HearScans();
  void TellAndKeep(const std::vector<team::Mark>& marks);
  void Keep();

  Refusals& refusals_;
  std::string map_frame_;
  WaitSet wait_set_;
  Reader<wire::Mark> reader_;
  Reader<wire::RelevantScan> scans_;
  Writer<wire::Mark> writer_;
  team::MarkJournal journal_;  // Used by the thread, once it runs; what follows, too.
  std::chrono::steady_clock::time_point tried_{};  // When it was last given something.

  mutable std::mutex mutex_;  // Guards what follows.
  team::MarkBook book_;
  std::map<team::ScanKey, Timestamp> stamps_;  // Of all scans that were heard of.
  std::map<team::ScanKey, Pose2> corrected_;   // Poses of scans by the last correction.
  std::vector<team::Mark> unkept_;
  std::size_t told_ = 0;  // Since all were told.

  std::jthread thread_;  // Last: it uses all others.
};

}  // namespace qwsm::dds
