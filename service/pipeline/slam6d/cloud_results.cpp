// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/cloud_results.hpp"

#include <fmt/format.h>

#include <utility>

#include "service/pipeline/slam6d/registration_results.hpp"

namespace slam6d::pipeline {

void CloudResults::Keep(const qwsm::team::CloudAnswer& answer) {
  const std::lock_guard lock(mutex_);
  std::vector<RegisteredScan>& scans = robots_[answer.robot].scans;
  scans.push_back({.name = fmt::format("scan{:03}", scans.size()),
                   .file = {},
                   .stamp = answer.step.stamp,
                   .T_odom_scan = answer.step.T_odom_sensor,
                   .cloud = WithinRange(answer.step.scan->cloud, options_.slam),
                   .step = answer.step.registration,
                   .time_s = qwsm::Seconds(answer.matching)});
}

void CloudResults::Finish(qwsm::team::CloudService& service) {
  for (auto& [robot, refinement] : service.Refine()) {
    const auto known = robots_.find(robot);
    if (known == robots_.end()) continue;
    Registration& registration = known->second;
    registration.series_size = registration.scans.size();
    registration.T_map_scan = refinement.T_map_scan;
    registration.refinement = std::move(refinement);
    WriteResults(registration, options_, folder_.Part(robot, true));
  }
}

}  // namespace slam6d::pipeline
