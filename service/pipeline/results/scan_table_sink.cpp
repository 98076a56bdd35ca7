// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/scan_table_sink.hpp"

#include <string_view>

#include "service/io/files/csv_row.hpp"

namespace qwsm::pipeline {
namespace {

constexpr std::string_view kHeader =
    "stamp_s,x_m,y_m,theta_rad,"
    "cov_xx_m2,cov_xy_m2,cov_xtheta_m_rad,cov_yy_m2,cov_ytheta_m_rad,cov_thetatheta_rad2,"
    "status,reason,relevant,pairs,overlap,residual_mm,trace,iterations,ms\n";

}  // namespace

double PositionTrace_m2(const MatchResult& match) {
  return match.nearest_sample_covariance(0, 0) + match.nearest_sample_covariance(1, 1);
}

ScanTableSink::ScanTableSink(const std::filesystem::path& path) : file_(path) {
  file_.stream() << kHeader;
}

void ScanTableSink::Take(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  io::CsvRow row;
  row.Add(step.stamp);
  for (const double value : {T_map_robot.x_m, T_map_robot.y_m, T_map_robot.theta_rad})
    row.Add(value);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) row.Add(step.map_robot.covariance(i, j));
  }
  row.Add(Name(step.status));
  row.Add(step.reason);
  row.Add(step.relevant ? "1" : "0");
  row.Add(static_cast<double>(step.match.pairs));
  row.Add(step.match.overlap);
  row.Add(step.match.mean_residual_m * 1e3);
  row.Add(PositionTrace_m2(step.match));
  row.Add(static_cast<double>(step.match.iterations));
  row.Add(std::chrono::duration<double, std::milli>(timed.duration).count());
  file_.stream() << row.Finish();
  file_.ThrowIfFailed();
}

}  // namespace qwsm::pipeline
