// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// scan_bench [--each] LOG...: what the scans of recorded logs cost, by the time the thread worked:
// the whole of Mapper::Process() with the default options, from ranges to pose and insertion, but
// not reading the log. Prints median, p99, p99.9 and longest; with --each the milliseconds of each
// scan, one a line, as scripts/compare_speed reads them. It compiles within older revisions, too.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#if __has_include("qwsm/logs/log_reader.hpp")
#include "qwsm/logs/log_reader.hpp"
#else  // As the header was called before libqwsm-logs was a component.
#include "service/io/log_reader.hpp"
#endif

namespace qwsm::bench {
namespace {

double Worked_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + 1e-6 * static_cast<double>(time.tv_nsec);
}

std::vector<Observation> Read(const std::filesystem::path& path) {
  std::vector<Observation> observations;
  const auto log = io::OpenLog(path);
  while (auto record = log->Next()) {
    if (auto* reading = std::get_if<io::ScanReading>(&*record)) {
      observations.push_back(
          {.scan = std::move(reading->scan), .T_odom_robot = reading->T_odom_robot});
    }
  }
  return observations;
}

std::vector<double> TimesOf(std::span<const Observation> observations) {
  std::vector<double> times_ms;
  times_ms.reserve(observations.size());
  Mapper mapper;
  for (const Observation& observation : observations) {
    const double before_ms = Worked_ms();
    const MappingStep step = mapper.Process(observation);
    times_ms.push_back(Worked_ms() - before_ms);
  }
  return times_ms;
}

void PrintQuantiles(const std::filesystem::path& log, std::vector<double> times_ms) {
  std::ranges::sort(times_ms);
  const auto quantile = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  std::printf("%-32s %6zu %8.3f %8.3f %8.3f %8.3f\n",
              log.filename().c_str(),
              times_ms.size(),
              quantile(0.5),
              quantile(0.99),
              quantile(0.999),
              times_ms.back());
}

// @return whether every log had scans.
bool Measure(std::span<char*> logs, bool each) {
  if (!each)
    std::puts("log                               scans   median      p99    p99.9  longest  (ms)");
  bool all_have_scans = true;
  for (const std::filesystem::path log : logs) {
    const std::vector<double> times_ms = TimesOf(Read(log));
    if (times_ms.empty()) {
      std::fprintf(stderr, "scan_bench: %s: no scans\n", log.c_str());
      all_have_scans = false;
    } else if (each) {
      for (const double time_ms : times_ms) std::printf("%.6f\n", time_ms);
    } else {
      PrintQuantiles(log, times_ms);
    }
  }
  return all_have_scans;
}

}  // namespace
}  // namespace qwsm::bench

int main(int argc, char** argv) {
  std::span<char*> logs(argv + 1, argv + argc);
  const bool each = !logs.empty() && std::string_view(logs.front()) == "--each";
  if (each) logs = logs.subspan(1);
  if (logs.empty() || std::string_view(logs.front()).starts_with("--")) {
    std::fputs("usage: scan_bench [--each] LOG...\n", stderr);
    return 2;
  }
  try {
    return qwsm::bench::Measure(logs, each) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_bench: %s\n", error.what());
    return 1;
  }
}
