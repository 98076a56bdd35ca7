// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "qwsm/mapping/relevant_scan.hpp"
#include "service/io/files/binary.hpp"

namespace qwsm::io {

/// Adds a relevant scan to bytes, in map files and journals; its ids are not among them.
void AddScan(BinaryWriter& writer, const RelevantScan& relevant);
/// Reads a relevant scan.
/// @throws BinaryError where there is none, or one that may not be matched.
RelevantScan ReadScan(BinaryReader& reader);

/// What a journal keeps of a relevant scan.
struct JournaledScan {
  RelevantScan relevant;
  std::optional<Pose2> T_odom_robot;  ///< Odometry for the robot to go on from.
  std::string component{};  ///< Of the map, that it was taken in; empty for the one all share.
};

/// Kind of the journals that keep these; see JournalFile.
inline constexpr std::string_view kScanJournal = "relevant scans of planar lasers, version 1";

std::string EncodeScan(const JournaledScan& scan);
/// Reads a relevant scan of a journal from bytes. @throws BinaryError where there is none.
JournaledScan DecodeScan(std::string_view bytes);

}  // namespace qwsm::io
