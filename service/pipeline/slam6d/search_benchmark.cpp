// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/search_benchmark.hpp"

#include <fmt/format.h>

#include <ctime>
#include <numeric>

#include "service/config/text_table.hpp"
#include "service/io/pictures/line_plot.hpp"

namespace slam6d::pipeline {
namespace {

/// Processor time: what others do on the machine hardly shows in it.
template <class Work>
double Milliseconds(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

std::size_t CountDifferent(const CachedSearch& a, const CachedSearch& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same =
        a.found(i) == b.found(i) && (!a.found(i) || a.distance2_m2(i) == b.distance2_m2(i));
    different += same ? 0 : 1;
  }
  return different;
}

/// The poses of a registration, at each of which neighbours are searched.
IcpTrace TraceOf(const ScanModel& ref, const ScanModel& cur, const SearchTask& task, double max_m) {
  const IcpOptions options{.metric = IcpMetric::kPointToPoint, .max_distance_m = max_m};
  IcpTrace trace;
  static_cast<void>(Align(ref, cur, task.T_ref_cur_guess, options, &trace));
  if (trace.size() > 1) trace.pop_back();
  return trace;
}

SearchTimes TimeSearches(const SearchTask& task, int bucket_size, double max_distance_m) {
  const KdTreeOptions tree{.bucket_size = bucket_size};
  const ScanModel ref(task.ref, tree);
  const ScanModel cur(task.cur, tree);
  const std::size_t size = cur.points.size();
  CachedSearch root(
      ref.tree, cur.points, {.max_distance_m = max_distance_m, .start = SearchStart::kRoot});
  CachedSearch cached(ref.tree, cur.points, {.max_distance_m = max_distance_m});
  SearchTimes times;
  times.bucket_size = bucket_size;
  SearchStatistics statistics;
  for (const Pose3& T_ref_cur : TraceOf(ref, cur, task, max_distance_m)) {
    times.root_ms_of_iteration.push_back(Milliseconds([&] {
      root.MoveTo(T_ref_cur);
      static_cast<void>(root.Find(0, size));
    }));
    times.cached_ms_of_iteration.push_back(Milliseconds([&] {
      cached.MoveTo(T_ref_cur);
      statistics += cached.Find(0, size);
    }));
    times.wrong += CountDifferent(root, cached);
  }
  const auto sum = [](const std::vector<double>& ms) {
    return std::accumulate(ms.begin(), ms.end(), 0.0);
  };
  times.root_ms = sum(times.root_ms_of_iteration);
  times.cached_ms = sum(times.cached_ms_of_iteration);
  times.proven_share = static_cast<double>(statistics.proven_unchanged) /
                       std::max(static_cast<double>(statistics.queries), 1.0);
  return times;
}

qwsm::io::PlotSeries SeriesOf(const std::string& label,
                              const qwsm::io::Color& color,
                              const std::vector<double>& values) {
  qwsm::io::PlotSeries series{.label = label, .color = color, .points = {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    series.points.emplace_back(static_cast<double>(i + 1), values[i]);
  }
  return series;
}

constexpr qwsm::io::Color kRootColor = qwsm::io::FromBytes(150, 150, 150);
constexpr qwsm::io::Color kCachedColor = qwsm::io::FromBytes(0, 90, 180);

}  // namespace

std::vector<SearchTimes> BenchSearch(const SearchTask& task,
                                     std::span<const int> bucket_sizes,
                                     double max_distance_m) {
  std::vector<SearchTimes> all;
  for (const int bucket_size : bucket_sizes) {
    all.push_back(TimeSearches(task, bucket_size, max_distance_m));
  }
  return all;
}

std::string SearchTable(std::span<const SearchTimes> all) {
  std::vector<std::vector<std::string>> rows{{"bucket size",
                                              "iterations",
                                              "root ms",
                                              "cached ms",
                                              "speed-up",
                                              "time saved %",
                                              "proven %",
                                              "wrong"}};
  for (const SearchTimes& times : all) {
    rows.push_back({fmt::format("{}", times.bucket_size),
                    fmt::format("{}", times.root_ms_of_iteration.size()),
                    fmt::format("{:.1f}", times.root_ms),
                    fmt::format("{:.1f}", times.cached_ms),
                    fmt::format("{:.2f}", times.root_ms / times.cached_ms),
                    fmt::format("{:.0f}", 100.0 * (1.0 - times.cached_ms / times.root_ms)),
                    fmt::format("{:.1f}", 100.0 * times.proven_share),
                    fmt::format("{}", times.wrong)});
  }
  return qwsm::config::FormatTable(rows);
}

void DrawSpeedUp(std::span<const SearchTimes> all, const std::filesystem::path& file) {
  qwsm::io::PlotSeries series{.label = "root / cached", .color = kCachedColor, .points = {}};
  for (const SearchTimes& times : all) {
    series.points.emplace_back(times.bucket_size, times.root_ms / times.cached_ms);
  }
  qwsm::io::WriteLinePlot(file,
                          {.title = "Speed-up of the cached search over a registration",
                           .x_label = "bucket size",
                           .y_label = "speed-up",
                           .series = {series}});
}

void DrawIterations(const SearchTimes& times, const std::filesystem::path& file) {
  qwsm::io::WriteLinePlot(
      file,
      {.title = fmt::format("Time of the searches, bucket size {}", times.bucket_size),
       .x_label = "iteration",
       .y_label = "ms",
       .series = {SeriesOf("from the root", kRootColor, times.root_ms_of_iteration),
                  SeriesOf("cached", kCachedColor, times.cached_ms_of_iteration)}});
}

}  // namespace slam6d::pipeline
