// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Maps logs of robots that were carried while they mapped; kUsage says how.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/metrics/relations.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "tests/support/carried.hpp"
#include "tests/support/recorded_log.hpp"

namespace {

using namespace qwsm;
using namespace qwsm::test;

constexpr const char* kUsage =
    R"(usage: evaluate_carried GAPS SEED LOG RELATIONS [LOG RELATIONS]...

Leaves a part out of each log, GAPS times with seeds from SEED on, as if the robot had been carried that
way, and prints a row of a table (Markdown) for each: after how many metres it was known to be lost, and
after how many more it was found; then the mean error of the corrected path by the relations, within
each side of the gap and, of those that lead across it, both as a multiple of the error of the same
relations in the unbroken log. `--`: never. Beforehand a row for the unbroken log. With 0 GAPS that is
all, and RELATIONS may be `-`.
)";

struct Drive {
  Trajectory trajectory;
  std::vector<std::size_t> lost_at;   // Scans.
  std::vector<std::size_t> found_at;
  std::vector<double> way_m;          // Until each scan.
};

Drive Mapped(const std::vector<Observation>& observations) {
  Drive drive;
  SelfCorrectingMapper mapper;
  double way_m = 0.0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    mapper.Process(observations[i]);
    if (mapper.losses() > drive.lost_at.size()) drive.lost_at.push_back(i);
    if (mapper.belief() == nullptr && drive.found_at.size() < mapper.losses()) {
      drive.found_at.push_back(i);
    }
    if (i > 0) {
      const Pose2 T_odom_last = *observations[i - 1].T_odom_robot;
      way_m += (T_odom_last.Inverse() * *observations[i].T_odom_robot).translation_m().norm();
    }
    drive.way_m.push_back(way_m);
  }
  const std::vector<UncertainPose2> map_robot = mapper.Correct().map_robot;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    drive.trajectory.push_back(
        {.stamp = observations[i].scan.stamp, .T_map_robot = map_robot[i].T_a_b});
  }
  return drive;
}

double Error_m(const std::vector<Relation>& relations, const Trajectory& trajectory) {
  return EvaluateRelations(relations, trajectory).all.translation_m.mean;
}

std::string Way(const Drive& drive, const std::vector<std::size_t>& scans, std::size_t from) {
  if (scans.empty()) return "--";
  return fmt::format("{:.1f} m", drive.way_m[scans.front()] - drive.way_m[from]);
}

struct Sides {
  std::vector<Relation> within;
  std::vector<Relation> across;
};

Sides Split(const std::vector<Relation>& relations,
            const std::vector<Observation>& unbroken,
            const LogGap& gap) {
  const Timestamp begin = unbroken[gap.first - 1].scan.stamp;
  const Timestamp end = unbroken[gap.first + gap.scans].scan.stamp;
  Sides sides;
  for (const Relation& relation : relations) {
    const auto [from, to] = std::minmax(relation.first, relation.second);
    const auto is_left_out = [&](Timestamp stamp) { return stamp > begin && stamp < end; };
    if (is_left_out(from) || is_left_out(to)) continue;
    (from <= begin && to >= end ? sides.across : sides.within).push_back(relation);
  }
  return sides;
}

void EvaluateGap(const std::string& log,
                 const std::vector<Observation>& unbroken,
                 const Trajectory& reference,
                 const std::vector<Relation>& relations,
                 unsigned seed) {
  const LogGap gap = RandomGap(unbroken.size(), seed);
  const Drive drive = Mapped(Carried(unbroken, gap));
  const Sides sides = Split(relations, unbroken, gap);
  const auto ratio = [&](const std::vector<Relation>& of) {
    return of.empty() ? std::string("none")
                      : fmt::format("{:.4f} ({:.2f})",
                                    Error_m(of, drive.trajectory),
                                    Error_m(of, drive.trajectory) / Error_m(of, reference));
  };
  const bool is_early = !drive.lost_at.empty() && drive.lost_at.front() < gap.first;
  fmt::print("| {} {} | {} + {} | {}{} | {}{} | {} | {} |\n",
             log,
             seed,
             gap.first,
             gap.scans,
             is_early ? "early " : "",
             Way(drive, drive.lost_at, gap.first),
             Way(drive, drive.found_at, gap.first),
             drive.lost_at.size() > 1 ? fmt::format(", {} times", drive.lost_at.size()) : "",
             ratio(sides.within),
             ratio(sides.across));
  std::cout.flush();
}

void Evaluate(const std::filesystem::path& log,
              const std::string& relations_file,
              int gaps,
              unsigned seed) {
  const std::vector<Observation> unbroken = ObservationsOf(log);
  const Drive drive = Mapped(unbroken);
  std::vector<Relation> relations;
  if (relations_file != "-") relations = io::ReadRelationsFile(relations_file);
  const std::string name = log.filename().string();
  fmt::print("| {} | unbroken | lost {} times | | {} | |\n",
             name,
             drive.lost_at.size(),
             relations.empty() ? "" : fmt::format("{:.4f}", Error_m(relations, drive.trajectory)));
  for (int i = 0; i < gaps; ++i) {
    EvaluateGap(name, unbroken, drive.trajectory, relations, seed + static_cast<unsigned>(i));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 5 || argc % 2 == 0) {
    std::cerr << kUsage;
    return EXIT_FAILURE;
  }
  fmt::print("| log and seed | gap | lost after | found after | within | across |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (int i = 3; i < argc; i += 2) {
    Evaluate(argv[i], argv[i + 1], std::stoi(argv[1]), static_cast<unsigned>(std::stoul(argv[2])));
  }
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}
