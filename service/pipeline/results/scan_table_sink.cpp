// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/scan_table_sink.hpp"

#include <fstream>
#include <string>
#include <string_view>

#include "service/io/files/csv_row.hpp"

namespace qwsm::pipeline {
namespace {

constexpr std::string_view kHeader =
    "stamp_s,x_m,y_m,theta_rad,"
    "cov_xx_m2,cov_xy_m2,cov_xtheta_m_rad,cov_yy_m2,cov_ytheta_m_rad,cov_thetatheta_rad2,"
    "status,reason,relevant,pairs,overlap,residual_mm,trace,iterations,ms,cpu_ms,epoch\n";
constexpr std::string_view kCorrectedHeader =
    "corrected_x_m,corrected_y_m,corrected_theta_rad,"
    "corrected_cov_xx_m2,corrected_cov_xy_m2,corrected_cov_xtheta_m_rad,corrected_cov_yy_m2,"
    "corrected_cov_ytheta_m_rad,corrected_cov_thetatheta_rad2\n";

}  // namespace

double PositionTrace_m2(const MatchResult& match) {
  return match.nearest_sample_covariance(0, 0) + match.nearest_sample_covariance(1, 1);
}

ScanTableSink::ScanTableSink(const std::filesystem::path& path) : file_(path) {
  file_.stream() << kHeader;
}

void ScanTableSink::Take(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  io::CsvRow row;
  row.Add(step.stamp);
  row.Add(step.map_robot);
  row.Add(Name(step.status));
  row.Add(step.reason);
  row.Add(step.relevant ? "1" : "0");
  row.Add(static_cast<double>(step.match.pairs));
  row.Add(step.match.overlap);
  row.Add(step.match.mean_residual_m * 1e3);
  row.Add(PositionTrace_m2(step.match));
  row.Add(static_cast<double>(step.match.iterations));
  row.Add(std::chrono::duration<double, std::milli>(timed.duration).count());
  row.Add(std::chrono::duration<double, std::milli>(timed.worked).count());
  row.Add(static_cast<double>(step.epoch));
  file_.stream() << row.Finish();
  file_.ThrowIfFailed();
}

void AddCorrectedPoses(const std::filesystem::path& table,
                       std::span<const std::optional<UncertainPose2>> corrected) {
  std::ifstream rows(table);
  io::AtomicFile wider(table);
  std::string row;
  std::getline(rows, row);
  wider.stream() << row << ',' << kCorrectedHeader;
  for (const std::optional<UncertainPose2>& map_robot : corrected) {
    std::getline(rows, row);
    io::CsvRow columns;
    columns.Add(map_robot);
    wider.stream() << row << ',' << columns.Finish();
  }
  wider.Commit();
}

}  // namespace qwsm::pipeline
