// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/apps/messages.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/apps/slam6d/scan_arguments.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/slam6d/scan_series.hpp"
#include "service/pipeline/slam6d/search_benchmark.hpp"
#include "service/pipeline/text/messages.hpp"

namespace slam6d::apps {
namespace {

struct BenchArguments {
  std::vector<std::filesystem::path> scans;
  std::optional<std::filesystem::path> output;
  double max_distance_m = 0.5;
  double max_range_m = 1e6;
  bool force = false;
};

constexpr std::array<int, 8> kBucketSizes{1, 2, 4, 8, 16, 25, 35, 50};
constexpr std::size_t kShownSize = 4;

/// The next scan, with the points that count. @throws qwsm::apps::UsageError if there are none.
pipeline::LoadedScan ReadScan(pipeline::ScanSeries& series, const BenchArguments& arguments) {
  pipeline::LoadedScan scan = *series.Next();
  for (const std::string& problem : scan.problems) qwsm::messages::Warn(problem);
  scan.cloud = InRange(scan.cloud, 0.0, arguments.max_range_m);
  if (!scan.cloud.empty()) return scan;
  throw qwsm::apps::UsageError(scan.file.string() + ": has no points to search within --max-range");
}

pipeline::SearchTask ReadTask(const BenchArguments& arguments) {
  pipeline::ScanSeries series(FindScans(arguments.scans, {}), {}, {});
  if (series.size() < 2) throw qwsm::apps::UsageError("two scans are needed");
  pipeline::LoadedScan ref = ReadScan(series, arguments);
  pipeline::LoadedScan cur = ReadScan(series, arguments);
  return {.ref = std::move(ref.cloud),
          .cur = std::move(cur.cloud),
          .T_ref_cur_guess = ref.T_odom_scan.Inverse() * cur.T_odom_scan};
}

ExitCode RunBench(const BenchArguments& arguments) {
  qwsm::apps::StartMessages({});
  const pipeline::SearchTask task = ReadTask(arguments);
  std::optional<qwsm::pipeline::ResultsFolder> folder;
  if (arguments.output) folder.emplace(*arguments.output, arguments.force, arguments.scans);
  const std::vector<pipeline::SearchTimes> times =
      BenchSearch(task, kBucketSizes, arguments.max_distance_m);
  qwsm::apps::Print("searches of one registration, {} on {} points, one thread\n{}",
                    task.cur.size(),
                    task.ref.size(),
                    SearchTable(times));
  std::size_t wrong = 0;
  for (const pipeline::SearchTimes& t : times) wrong += t.wrong;
  if (folder) {
    DrawSpeedUp(times, *folder / qwsm::pipeline::ResultFile::kSpeedUp);
    DrawIterations(times[kShownSize], *folder / qwsm::pipeline::ResultFile::kIterations);
  }
  return wrong == 0 ? ExitCode::kDone : ExitCode::kFailed;
}

}  // namespace

Command AddBenchSearchCommand(CLI::App& program) {
  CLI::App* parser =
      AddParser(program, "bench-search", "cached search against search from the root");
  auto arguments = std::make_shared<BenchArguments>();
  parser->footer(
      "  slam6d bench-search dat/                   a table for the first two scans\n"
      "  slam6d bench-search dat/ --output figure5  and pictures like Figure 5 of Nüchter et al. "
      "(2007)");
  parser->add_option("SCANS", arguments->scans, "a folder of scans, or two files")
      ->required()
      ->type_name("");
  parser->add_option("-o,--output", arguments->output, "folder for the pictures")->type_name("DIR");
  parser->add_option("--max-distance", arguments->max_distance_m, "of a pair, in metres")
      ->check(qwsm::apps::NumberBetween(1e-6, 1e6))
      ->capture_default_str();
  parser->add_option("--max-range", arguments->max_range_m, "farther points are misses, in metres")
      ->check(qwsm::apps::NumberBetween(1e-6, 1e6));
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  return {.parser = parser, .run = [arguments] { return RunBench(*arguments); }};
}

}  // namespace slam6d::apps
