// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/corrected_run.hpp"

#include <algorithm>
#include <string_view>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/csv_row.hpp"
#include "service/io/trajectories/graph_file.hpp"

namespace qwsm::pipeline {
namespace {

constexpr std::string_view kLoopHeader =
    "from_stamp_s,to_stamp_s,x_m,y_m,theta_rad,"
    "cov_xx_m2,cov_xy_m2,cov_xtheta_m_rad,cov_yy_m2,cov_ytheta_m_rad,cov_thetatheta_rad2,"
    "overlap,reduced_chi2,verdict\n";

std::string LineOf(const Loop& loop, const ScanMap& map) {
  io::CsvRow row;
  row.Add(map.scans()[loop.edge.from].scan.stamp);
  row.Add(map.scans()[loop.edge.to].scan.stamp);
  row.Add(MeasuredBy(loop.edge));
  row.Add(loop.overlap);
  row.Add(loop.reduced_chi2);
  row.Add(Name(loop.verdict));
  return row.Finish();
}

}  // namespace

LoopCounts CountLoops(const std::vector<Loop>& loops) {
  const auto accepted = std::ranges::count(loops, LoopVerdict::kAccepted, &Loop::verdict);
  return {.accepted = static_cast<std::size_t>(accepted), .found = loops.size()};
}

void CorrectionSink::Take(const TimedStep& timed) { corrector_.Take(timed.step); }

CorrectedRun CorrectionSink::Correct(const ScanMap& map) const {
  Correction correction = corrector_.Correct();
  ScanMap corrected = Reinserted(map, correction.map_node);
  return {.correction = std::move(correction), .map = std::move(corrected)};
}

void WriteLoops(const ResultsFolder& folder, const Correction& correction, const ScanMap& map) {
  io::AtomicFile table(folder / "loops.csv");
  table.stream() << kLoopHeader;
  for (const Loop& loop : correction.loops) table.stream() << LineOf(loop, map);
  table.Commit();
  io::WriteG2oFile(folder / "graph.g2o", correction.graph);
  io::WriteToroFile(folder / "graph.toro", correction.graph);
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
