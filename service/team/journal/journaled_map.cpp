// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/journal/journaled_map.hpp"

#include <algorithm>
#include <utility>

#include "service/io/files/binary.hpp"
#include "service/io/journal/epoch_codec.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/team/scans/robot_name.hpp"

namespace qwsm::team {
namespace {

TeamScan ScanFromJournal(const io::JournalEntry& entry) {
  io::JournaledScan scan = io::DecodeScan(entry.contents);
  return {.key = {.service = entry.service, .robot = entry.robot, .sequence = entry.sequence},
          .component = std::move(scan.component),
          .scan = std::move(scan.relevant.scan),
          .map_robot = scan.relevant.map_robot,
          .T_odom_robot = scan.T_odom_robot};
}

// What was let in by mistake must not come back for ever.
void RequireRobotName(std::string_view name) {
  if (!IsRobotName(name)) throw io::BinaryError("a name in it is no namespace");
}

std::vector<io::JournaledPose> PosesFromJournal(const io::JournalEntry& entry) {
  if (entry.sequence >= kMostEpochs) throw io::BinaryError("its number is higher than any count");
  std::vector<io::JournaledPose> poses = io::DecodeEpoch(entry.contents);
  for (const io::JournaledPose& pose : poses) RequireRobotName(pose.component);
  return poses;
}

}  // namespace

io::JournalEntry ToJournal(const TeamScan& scan) {
  io::JournaledScan journaled;
  journaled.relevant.scan = scan.scan;
  journaled.relevant.map_robot = scan.map_robot;
  journaled.T_odom_robot = scan.T_odom_robot;
  journaled.component = scan.component;
  return {.service = scan.key.service,
          .robot = scan.key.robot,
          .sequence = scan.key.sequence,
          .stamp = scan.scan.stamp,
          .contents = io::EncodeScan(journaled)};
}

io::JournalEntry ToJournal(const TeamEpoch& epoch) {
  std::vector<io::JournaledPose> poses;
  poses.reserve(epoch.scans.size());
  for (const MovedScan& scan : epoch.scans) {
    poses.push_back({.service = scan.key.service,
                     .robot = scan.key.robot,
                     .sequence = scan.key.sequence,
                     .component = scan.component,
                     .map_robot = scan.map_robot});
  }
  return {.service = epoch.rank.service,
          .robot = {},
          .sequence = epoch.rank.number,
          .stamp = epoch.stamp,
          .contents = io::EncodeEpoch(poses)};
}

void JournaledMap::Take(const io::JournalEntry& entry) {
  if (!io::IsEpoch(entry.contents)) {
    TeamScan scan = ScanFromJournal(entry);
    RequireRobotName(scan.key.robot);
    RequireRobotName(scan.component);
    if (!index_.try_emplace(scan.key, scans_.size()).second) return;
    std::string component = scan.component;
    scans_.push_back({.scan = std::move(scan), .component = std::move(component)});
    return;
  }
  for (io::JournaledPose& pose : PosesFromJournal(entry)) {
    const auto known = index_.find({.service = std::move(pose.service),
                                    .robot = std::move(pose.robot),
                                    .sequence = pose.sequence});
    if (known == index_.end()) continue;
    scans_[known->second].scan.map_robot = pose.map_robot;
    scans_[known->second].component = std::move(pose.component);
  }
  last_epoch_ = std::max(last_epoch_, {.number = entry.sequence, .service = entry.service});
}

}  // namespace qwsm::team
