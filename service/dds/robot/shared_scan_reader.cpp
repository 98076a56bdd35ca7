// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/shared_scan_reader.hpp"

#include <map>
#include <utility>

#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"

namespace qwsm::dds {

SharedScanReader::SharedScanReader(const Participant& participant)
    : wait_set_(participant),
      reader_(participant, kSharedScansTopic, Profile::kSharedScans),
      epochs_(participant, RobotNames("").Topic(kMapEpochTopic), Profile::kSharedScans) {
  wait_set_.Add(reader_.handle());
}

std::vector<team::TeamScan> SharedScanReader::Take(std::chrono::nanoseconds timeout) {
  wait_set_.Wait(timeout);
  std::vector<team::TeamScan> scans;
  reader_.TakeAll([&](const wire::RelevantScan& sample) {
    if (ObjectionTo(sample).empty()) {
      team::TeamScan scan = FromWire(sample);
      if (team::ObjectionTo(scan).empty()) return scans.push_back(std::move(scan));
    }
    ++refused_;
  });
  return scans;
}

void SharedScanReader::Settle(std::vector<team::TeamScan>& scans) {
  epochs_.TakeAll([this](const wire::MapEpoch& sample) {
    if (!ObjectionTo(sample).empty()) return;
    team::TeamEpoch epoch = FromWire(sample);
    if (newest_.rank < epoch.rank) newest_ = std::move(epoch);
  });
  std::map<team::ScanKey, const team::MovedScan*> moved;
  for (const team::MovedScan& scan : newest_.scans) moved[scan.key] = &scan;
  for (team::TeamScan& scan : scans) {
    const auto there = moved.find(scan.key);
    if (there == moved.end()) continue;
    scan.component = there->second->component;
    scan.map_robot = there->second->map_robot;
  }
}

}  // namespace qwsm::dds
