// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "service/io/journal/journal_entry.hpp"
#include "service/team/scans/team_epoch.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::team {

io::JournalEntry ToJournal(const TeamScan& scan);
io::JournalEntry ToJournal(const TeamEpoch& epoch);

/// A scan of a journal. Its pose is in the component that it is in now.
struct JournaledTeamScan {
  TeamScan scan;
  std::string component;
};

/// The relevant scans of a journal, where the last correction has put them.
class JournaledMap {
 public:
  /// Takes the next entry. @throws io::BinaryError where it holds nothing that can be read.
  void Take(const io::JournalEntry& entry);

  /// The scans that were taken, in their order, each once. To be called once.
  std::vector<JournaledTeamScan> TakeScans() { return std::move(scans_); }
  /// The last correction, which counts more than all others; of number 0 if there was none.
  const EpochRank& last_epoch() const { return last_epoch_; }

 private:
  std::vector<JournaledTeamScan> scans_;
  std::unordered_map<ScanKey, std::size_t, ScanKeyHash> index_;
  EpochRank last_epoch_;
};

}  // namespace qwsm::team
