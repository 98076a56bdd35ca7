// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/wait_set.hpp"
#include "service/team/scans/team_epoch.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::dds {

/// Hears the relevant scans that services share: all there ever were, and those that come, and the
/// corrections of where they belong.
class SharedScanReader {
 public:
  /// Subscribes. @throws DdsError.
  explicit SharedScanReader(const Participant& participant);

  /// Whether some service shares its scans.
  bool has_writer() const { return reader_.writer_count() > 0; }
  /// All scans that arrived since the last call; waits for the first one if there is none. Those
  /// that may not be taken into a map are left out.
  std::vector<team::TeamScan> Take(std::chrono::nanoseconds timeout);
  /// Puts scans where the newest correction says that they are. What came after that is where it
  /// was told to be.
  void Settle(std::vector<team::TeamScan>& scans);
  /// How many were left out so far.
  std::size_t refused() const { return refused_; }

 private:
  WaitSet wait_set_;
  Reader<wire::RelevantScan> reader_;
  Reader<wire::MapEpoch> epochs_;
  team::TeamEpoch newest_;
  std::size_t refused_ = 0;
};

}  // namespace qwsm::dds
