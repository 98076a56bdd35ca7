// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace qwsm::team {

/// Notices that what tells of a robot's motion is of another time than its scans, as by a clock of
/// its own: then it is of no use, and all else goes on.
class ClockWatch {
 public:
  /// What is of another time than its scan by more is not late, but of another clock, or gone.
  static constexpr std::chrono::nanoseconds kApart = std::chrono::seconds(1);
  /// After so many scans in a row it is told.
  static constexpr int kScans = 10;

  /// Notes a scan. @param apart how much newer it is than all odometry, or, as a negative number,
  /// how much older; 0 where it has odometry, or is to have none.
  /// @return what to tell; mostly nothing.
  std::string NoteOdometry(std::chrono::nanoseconds apart);
  /// The same of the gyro. @param is_apart whether it tells only of another time.
  std::string NoteGyro(bool is_apart);

 private:
  int without_odometry_ = 0;  // Scans in a row.
  int without_gyro_ = 0;
};

}  // namespace qwsm::team
