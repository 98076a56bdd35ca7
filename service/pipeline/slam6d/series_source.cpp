// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/series_source.hpp"

#include <utility>

namespace slam6d::pipeline {

using qwsm::team::CloudObservation;

SeriesSource::SeriesSource(ScanSeries& series, std::chrono::nanoseconds period, Warn warn)
    : series_(series), period_(period), warn_(std::move(warn)), ahead_(Read()) {}

std::optional<CloudObservation> SeriesSource::Next() {
  if (ahead_) ++given_;
  return std::exchange(ahead_, Read());
}

qwsm::pipeline::SourceProgress SeriesSource::progress() const {
  return {.scans = given_,
          .dropped = 0,
          .share = static_cast<double>(read_) / static_cast<double>(series_.size())};
}

std::optional<CloudObservation> SeriesSource::Read() {
  while (std::optional<LoadedScan> loaded = series_.Next()) {
    const auto stamp = static_cast<std::int64_t>(read_++) * period_;
    for (const std::string& problem : loaded->problems) warn_(problem);
    if (loaded->cloud.empty()) continue;
    return CloudObservation{.scan = {.stamp = loaded->stamp.value_or(stamp),
                                     .cloud = std::move(loaded->cloud),
                                     .T_robot_sensor = {}},
                            .T_odom_robot = loaded->T_odom_scan};
  }
  return std::nullopt;
}

}  // namespace slam6d::pipeline
