// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/shared_scan_reader.hpp"

#include <utility>

#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"

namespace qwsm::dds {

SharedScanReader::SharedScanReader(const Participant& participant)
    : wait_set_(participant), reader_(participant, kSharedScansTopic, Profile::kSharedScans) {
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

}  // namespace qwsm::dds
