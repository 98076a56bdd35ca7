// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/report/map_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/sensor/scan_points.hpp"
#include "service/io/pictures/covariance_ellipse.hpp"
#include "service/io/pictures/png_writer.hpp"

namespace qwsm::pipeline {
namespace {

/// Larger maps are shown with cells put together.
constexpr int kMostCellsAcross = 3000;

/// Cells put together, `step` by `step`, each as its most telling one; rows from the top.
std::vector<std::uint8_t> CellsFromTop(const OccupancyGrid& grid, int step) {
  const int rows = (grid.height + step - 1) / step;
  const auto columns = static_cast<std::size_t>((grid.width + step - 1) / step);
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(rows) * columns);
  for (int y = 0; y < grid.height; ++y) {
    std::uint8_t* const row = &cells[static_cast<std::size_t>(rows - 1 - y / step) * columns];
    for (int x = 0; x < grid.width; ++x) {
      std::uint8_t& cell = row[x / step];
      cell = std::max(cell, static_cast<std::uint8_t>(grid.At(x, y)));
    }
  }
  return cells;
}

/// A map as a picture of its cells, 0 unknown, 1 free, 2 occupied, and where it lies.
Json GridJson(const OccupancyGrid& grid) {
  const int step = (std::max(grid.width, grid.height) + kMostCellsAcross - 1) / kMostCellsAcross;
  std::ostringstream png;
  io::WriteCellsPng(png, (grid.width + step - 1) / step, CellsFromTop(grid, step));
  Json json;
  json["cell_m"] = grid.cell_m * step;
  json["x_m"] = grid.origin_map_m.x();
  json["y_m"] = grid.origin_map_m.y();
  json["picture"] = "data:image/png;base64," + Base64(std::string_view(png.str()));
  return json;
}

/// The scans of which the page holds a row: all, or the worst of every so many.
std::vector<std::size_t> RowsToShow(const MapReport& report, std::size_t stride) {
  const std::vector<io::PathPose>& path = report.overlay.path;
  const auto badness = [&](std::size_t scan) {
    if (path[scan].status == StepStatus::kDeadReckoned) {
      return std::numeric_limits<double>::infinity();
    }
    return std::isnan(report.residuals_mm[scan]) ? -1.0 : report.residuals_mm[scan];
  };
  std::vector<std::size_t> rows;
  for (std::size_t first = 0; first < path.size(); first += stride) {
    std::size_t worst = first;
    for (std::size_t scan = first; scan < std::min(first + stride, path.size()); ++scan) {
      if (badness(scan) > badness(worst)) worst = scan;
    }
    rows.push_back(worst);
  }
  return rows;
}

/// A column of numbers, one per row.
template <class NumberOf>
Json Column(const std::vector<std::size_t>& rows, const NumberOf& number_of) {
  std::vector<float> numbers;
  numbers.reserve(rows.size());
  for (const std::size_t row : rows) numbers.push_back(static_cast<float>(number_of(row)));
  return Base64(std::span<const float>(numbers));
}

void AddPoses(Json& columns, const MapReport& report, const std::vector<std::size_t>& rows) {
  const std::vector<io::PathPose>& path = report.overlay.path;
  const auto pose = [&](std::size_t row) { return path[row].map_robot.T_a_b; };
  columns["x_m"] = Column(rows, [&](std::size_t row) { return pose(row).x_m; });
  columns["y_m"] = Column(rows, [&](std::size_t row) { return pose(row).y_m; });
  columns["theta_rad"] = Column(rows, [&](std::size_t row) { return pose(row).theta_rad; });
  const auto axes = [&](std::size_t row) { return io::HalfAxes95(path[row].map_robot.covariance); };
  columns["axis_ax_m"] = Column(rows, [&](std::size_t row) { return axes(row)(0, 0); });
  columns["axis_ay_m"] = Column(rows, [&](std::size_t row) { return axes(row)(1, 0); });
  columns["axis_bx_m"] = Column(rows, [&](std::size_t row) { return axes(row)(0, 1); });
  columns["axis_by_m"] = Column(rows, [&](std::size_t row) { return axes(row)(1, 1); });
  columns["sigma_deg"] = Column(rows, [&](std::size_t row) {
    return RadiansToDegrees(std::sqrt(std::max(path[row].map_robot.covariance(2, 2), 0.0)));
  });
  const Trajectory& answered = report.overlay.answered;
  if (answered.size() != path.size()) return;
  columns["answered_x_m"] =
      Column(rows, [&](std::size_t row) { return answered[row].T_map_robot.x_m; });
  columns["answered_y_m"] =
      Column(rows, [&](std::size_t row) { return answered[row].T_map_robot.y_m; });
  columns["answered_theta_rad"] =
      Column(rows, [&](std::size_t row) { return answered[row].T_map_robot.theta_rad; });
}

Json ScansJson(const MapReport& report) {
  const std::vector<io::PathPose>& path = report.overlay.path;
  const std::size_t stride = std::max<std::size_t>(1, (path.size() + kMostRows - 1) / kMostRows);
  const std::vector<std::size_t> rows = RowsToShow(report, stride);
  Json json;
  json["count"] = path.size();
  json["stride"] = stride;
  json["first_stamp_s"] = path.empty() ? 0.0 : Seconds(path.front().stamp);
  Json& columns = json["columns"];
  columns["number"] = Column(rows, [](std::size_t row) { return row; });
  columns["time_s"] =
      Column(rows, [&](std::size_t row) { return Seconds(path[row].stamp - path.front().stamp); });
  columns["status"] =
      Column(rows, [&](std::size_t row) { return static_cast<int>(path[row].status); });
  columns["residual_mm"] = Column(rows, [&](std::size_t row) { return report.residuals_mm[row]; });
  columns["ms"] = Column(rows, [&](std::size_t row) { return report.times_ms[row]; });
  AddPoses(columns, report, rows);
  json["statuses"] = Json::Array();
  for (int status = 0; status <= static_cast<int>(StepStatus::kLost); ++status) {
    json["statuses"].Add(Name(static_cast<StepStatus>(status)));
  }
  return json;
}

/// A path that is only drawn; its stamps do not matter.
Json PathJson(const Trajectory& path) {
  const std::size_t stride = std::max<std::size_t>(1, (path.size() + kMostRows - 1) / kMostRows);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < path.size(); i += stride) rows.push_back(i);
  Json json;
  json["x_m"] = Column(rows, [&](std::size_t i) { return path[i].T_map_robot.x_m; });
  json["y_m"] = Column(rows, [&](std::size_t i) { return path[i].T_map_robot.y_m; });
  return json;
}

Json LoopsJson(const MapReport& report) {
  Json json = Json::Array();
  const std::vector<Loop>& loops = report.correction->loops;
  const auto time_s = [&](NodeId node) {
    return Seconds(report.relevant[node].scan.stamp - report.overlay.path.front().stamp);
  };
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const io::LoopLine& line = report.overlay.loops[i];
    Json loop;
    loop["from_s"] = time_s(loops[i].edge.from);
    loop["to_s"] = time_s(loops[i].edge.to);
    loop["overlap"] = loops[i].overlap;
    loop["reduced_chi2"] = loops[i].reduced_chi2;
    loop["verdict"] = Name(loops[i].verdict);
    loop["accepted"] = line.is_accepted;
    loop["line_m"] = Json::Array();
    for (const double end :
         {line.from_map_m.x(), line.from_map_m.y(), line.to_map_m.x(), line.to_map_m.y()}) {
      loop["line_m"].Add(std::round(1e3 * end) * 1e-3);
    }
    json.Add(std::move(loop));
  }
  return json;
}

Json DoubtfulJson(const MapReport& report) {
  Json json = Json::Array();
  for (const DoubtfulScan& doubtful : report.doubtful) {
    const io::PathPose& pose = report.overlay.path[doubtful.number];
    std::vector<float> points_m;
    for (const ScanPoint& point : HitsOf(doubtful.scan)) {
      points_m.push_back(static_cast<float>(point.p_robot_m.x()));
      points_m.push_back(static_cast<float>(point.p_robot_m.y()));
    }
    Json scan;
    scan["number"] = doubtful.number;
    scan["time_s"] = Seconds(pose.stamp - report.overlay.path.front().stamp);
    scan["status"] = Name(doubtful.status);
    scan["reason"] = doubtful.reason;
    scan["residual_mm"] = 1e3 * doubtful.residual_m;
    scan["overlap"] = doubtful.overlap;
    scan["pairs"] = doubtful.pairs;
    scan["pose"] = Json::Array();
    const Pose2& T_map_robot = pose.map_robot.T_a_b;
    for (const double part : {T_map_robot.x_m, T_map_robot.y_m, T_map_robot.theta_rad}) {
      scan["pose"].Add(part);
    }
    scan["points_m"] = Base64(std::span<const float>(points_m));
    json.Add(std::move(scan));
  }
  return json;
}

}  // namespace

void WriteMapReport(const std::filesystem::path& path,
                    const RunTitle& title,
                    const MapReport& report) {
  Json data = ReportData(title);
  data["kind"] = "map";
  data["metrics"] = report.metrics;
  if (report.map != nullptr) data["map"] = GridJson(*report.map);
  if (report.before != nullptr) data["before"] = GridJson(*report.before);
  data["scans"] = ScansJson(report);
  data["odometry"] = PathJson(report.overlay.odometry);
  data["truth"] = PathJson(report.overlay.truth);
  if (report.correction != nullptr) data["loops"] = LoopsJson(report);
  data["doubtful"] = DoubtfulJson(report);
  WriteReportPage(path, title, data);
}

}  // namespace qwsm::pipeline
