// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/corrected_run.hpp"

#include <algorithm>
#include <string_view>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/csv_row.hpp"
#include "service/io/trajectories/graph_file.hpp"
#include "service/pipeline/results/result_file.hpp"
#include "service/pipeline/run/parallel.hpp"

namespace qwsm::pipeline {
namespace {

constexpr std::string_view kLoopHeader =
    "from_stamp_s,to_stamp_s,x_m,y_m,theta_rad,"
    "cov_xx_m2,cov_xy_m2,cov_xtheta_m_rad,cov_yy_m2,cov_ytheta_m_rad,cov_thetatheta_rad2,"
    "overlap,reduced_chi2,verdict\n";

constexpr std::string_view kEpochHeader =
    "epoch,from_stamp_s,scan_stamp_s,x_m,y_m,theta_rad,"
    "cov_xx_m2,cov_xy_m2,cov_xtheta_m_rad,cov_yy_m2,cov_ytheta_m_rad,cov_thetatheta_rad2\n";

std::string LineOf(const Loop& loop, std::span<const RelevantScan> scans) {
  io::CsvRow row;
  row.Add(scans[loop.edge.from].scan.stamp);
  row.Add(scans[loop.edge.to].scan.stamp);
  row.Add(MeasuredBy(loop.edge));
  row.Add(loop.overlap);
  row.Add(loop.reduced_chi2);
  row.Add(Name(loop.verdict));
  return row.Finish();
}

}  // namespace

MapFigures FiguresOf(const ScanMap& map) {
  return {.points = map.surfaces().quadtree().Statistics(), .scans = map.scans().size()};
}

LoopCounts CountLoops(const Correction& correction, std::size_t epochs) {
  const std::vector<Loop>& loops = correction.loops;
  const auto accepted = std::ranges::count(loops, LoopVerdict::kAccepted, &Loop::verdict);
  return {.accepted = static_cast<std::size_t>(accepted), .found = loops.size(), .epochs = epochs};
}

std::vector<StampedAnswer> AnswersOf(std::span<const io::PathPose> path) {
  std::vector<StampedAnswer> answers;
  answers.reserve(path.size());
  for (const io::PathPose& pose : path) {
    answers.push_back({.stamp = pose.stamp, .map_robot = pose.map_robot});
  }
  return answers;
}

CorrectedRun CorrectAtTheEnd(SelfCorrectingMapper& mapper) {
  const MapFigures answered_in = FiguresOf(mapper.mapper().map());
  mapper.ForgetPoints();  // Now, so that the last correction can take their room.
  GiveBackFreeMemory();
  FinishedDrive finished = mapper.Finish();
  return {.correction = std::move(finished.correction),
          .scans = std::move(finished.scans),
          .answered_in = answered_in,
          .epochs = {mapper.epochs().begin(), mapper.epochs().end()}};
}

void WriteLoops(const std::filesystem::path& folder,
                const Correction& correction,
                std::span<const RelevantScan> scans) {
  io::AtomicFile table(folder / ResultFile::kLoops);
  table.stream() << kLoopHeader;
  for (const Loop& loop : correction.loops) table.stream() << LineOf(loop, scans);
  table.Commit();
  io::WriteG2oFile(folder / ResultFile::kGraphG2o, correction.graph);
  io::WriteToroFile(folder / ResultFile::kGraphToro, correction.graph);
}

void WriteEpochs(const std::filesystem::path& folder, const CorrectedRun& run) {
  if (run.epochs.empty()) return;
  io::AtomicFile table(folder / ResultFile::kEpochs);
  table.stream() << kEpochHeader;
  for (std::size_t i = 0; i < run.epochs.size(); ++i) {
    const MapEpoch& epoch = run.epochs[i];
    for (std::size_t node = 0; node < epoch.map_node.size(); ++node) {
      io::CsvRow row;
      row.Add(static_cast<double>(i + 1));
      row.Add(epoch.stamp);
      row.Add(run.scans[node].scan.stamp);
      row.Add(epoch.map_node[node]);
      table.stream() << row.Finish();
    }
  }
  table.Commit();
}

std::vector<io::LoopLine> LoopLines(const Correction& correction) {
  std::vector<io::LoopLine> lines;
  lines.reserve(correction.loops.size());
  const auto place = [&](NodeId node) { return correction.map_node[node].T_a_b.translation_m(); };
  for (const Loop& loop : correction.loops) {
    lines.push_back({.from_map_m = place(loop.edge.from),
                     .to_map_m = place(loop.edge.to),
                     .is_accepted = loop.verdict == LoopVerdict::kAccepted});
  }
  return lines;
}

}  // namespace qwsm::pipeline
