// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/registration.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <memory>

namespace slam6d::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

/// The refinement takes about as long as the registrations before it.
constexpr double kShareOfScans = 0.6;

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

RegisteredScan Add(LoadedScan loaded, Slam& slam) {
  const Clock::time_point begin = Clock::now();
  RegisteredScan scan{.name = std::move(loaded.name),
                      .file = std::move(loaded.file),
                      .stamp = loaded.stamp.value_or(
                          std::chrono::seconds(static_cast<std::int64_t>(loaded.number))),
                      .T_odom_scan = loaded.T_odom_scan,
                      .cloud = WithinRange(loaded.cloud, slam.options()),
                      .step = {}};
  scan.step = slam.Add(scan.cloud, loaded.T_odom_scan);
  scan.time_s = SecondsSince(begin);
  return scan;
}

void Refine(Slam& slam, Registration& result, const RegistrationObserver& observer) {
  const Clock::time_point begin = Clock::now();
  result.refinement = slam.Refine([&](const RefinementProgress& progress) {
    const auto done = static_cast<double>(progress.fits);
    const double share = done / (done + static_cast<double>(progress.waiting));
    observer.show(kShareOfScans + (1.0 - kShareOfScans) * share,
                  fmt::format("fitting all to each other, {} fits", progress.fits));
    return !observer.should_stop();
  });
  result.refinement_time_s = SecondsSince(begin);
  result.interrupted = observer.should_stop();
}

}  // namespace

PointCloud WithinRange(const PointCloud& cloud, const SlamOptions& options) {
  const double max_range_m =
      options.max_range_m > 0.0 ? options.max_range_m : std::numeric_limits<double>::max();
  return InRange(cloud, options.min_range_m, max_range_m);
}

Registration RegisterSeries(ScanSeries& series,
                            const options::RegistrationOptions& options,
                            const RegistrationObserver& observer) {
  const std::unique_ptr<LoopCloser> closer = graph::MakeLoopCloser(options.loop_error);
  Slam slam(options.slam, *closer);
  Registration result;
  result.series_size = series.size();
  const double share_of_scans = options.slam.refinement.enabled ? kShareOfScans : 1.0;
  while (!result.interrupted) {
    std::optional<LoadedScan> loaded = series.Next();
    if (!loaded) break;
    for (const std::string& problem : loaded->problems) observer.warn(problem);
    result.scans.push_back(Add(std::move(*loaded), slam));
    const double share =
        static_cast<double>(result.scans.size()) / static_cast<double>(series.size());
    observer.show(share_of_scans * share,
                  fmt::format("{}/{} scans", result.scans.size(), series.size()));
    result.interrupted = observer.should_stop();
  }
  if (!result.interrupted) Refine(slam, result, observer);
  result.T_map_scan = slam.T_map_scan();
  return result;
}

}  // namespace slam6d::pipeline
