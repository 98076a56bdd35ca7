// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/trajectory_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "service/io/pictures/axis.hpp"
#include "service/io/pictures/covariance_ellipse.hpp"
#include "service/io/pictures/map_frame.hpp"
#include "service/io/pictures/path_drawing.hpp"

namespace qwsm::io {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr LineStyle kHalo{.color = {1.0, 1.0, 1.0, 0.75}, .width_px = 6.0};
// Wider than the path, which is drawn on it: where the two agree the path has dark edges.
constexpr LineStyle kTruthStyle{.color = FromBytes(60, 60, 60), .width_px = 5.0};
constexpr LineStyle kOdometryStyle{
    .color = FromBytes(120, 125, 132), .width_px = 1.6, .dash_px = 6.0};
constexpr LineStyle kAnsweredStyle{.color = FromBytes(70, 75, 82), .width_px = 1.2, .dash_px = 2.0};
constexpr LineStyle kLoopStyle{.color = FromBytes(0, 130, 60, 0.45), .width_px = 1.0};
constexpr LineStyle kRefusedStyle{.color = FromBytes(225, 20, 30, 0.8), .width_px = 1.4};
constexpr LineStyle kEllipseStyle{.color = FromBytes(150, 0, 140), .width_px = 1.1};
constexpr Color kEllipseFill = FromBytes(150, 0, 140, 0.12);
constexpr Color kDeadReckoned = FromBytes(225, 20, 30);
constexpr double kPathWidth_px = 2.8;
constexpr double kDot_px = 3.0;

// From the beginning to the end, as a share of the path.
Color ColorAlongPath(double share) {
  constexpr std::array kStops = {FromBytes(0, 110, 200),
                                 FromBytes(0, 160, 150),
                                 FromBytes(90, 175, 40),
                                 FromBytes(240, 150, 0)};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double rest = at - static_cast<double>(below);
  const Color& a = kStops[below];
  const Color& b = kStops[below + 1];
  return {a.red + rest * (b.red - a.red),
          a.green + rest * (b.green - a.green),
          a.blue + rest * (b.blue - a.blue)};
}

void DrawDot(Canvas& canvas, const Eigen::Vector2d& center_px) {
  canvas.FillPolygon(EllipseOutline(center_px, kDot_px * Eigen::Matrix2d::Identity()),
                     kDeadReckoned);
}

std::string MinutesAndSeconds(Timestamp time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time).count();
  const std::string rest = std::to_string(seconds % 60);
  return std::to_string(seconds / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

// An ellipse of the position, where it is drawn.
struct PlacedEllipse {
  Eigen::Vector2d center_map_m;
  Eigen::Matrix2d half_axes_m;
};

// Ellipses along the path, far enough from each other not to hide it.
std::vector<PlacedEllipse> EllipsesAlong(const std::vector<PathPose>& path, double apart_m) {
  std::vector<PlacedEllipse> ellipses;
  double since_last_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d here_m = path[i].map_robot.T_a_b.translation_m();
    since_last_m += (here_m - path[i - 1].map_robot.T_a_b.translation_m()).norm();
    if (since_last_m < apart_m) continue;
    ellipses.push_back({here_m, HalfAxes95(path[i].map_robot.covariance)});
    since_last_m = 0.0;
  }
  return ellipses;
}

double EnlargementOf(const std::vector<PlacedEllipse>& ellipses, double px_per_m) {
  std::vector<double> radii_px;
  for (const PlacedEllipse& ellipse : ellipses) {
    radii_px.push_back(ellipse.half_axes_m.colwise().norm().maxCoeff() * px_per_m);
  }
  return Enlargement(std::move(radii_px));
}

LegendItem TimeItem(const std::vector<PathPose>& path) {
  constexpr int kSteps = 80;
  const auto [first, last] = std::ranges::minmax(path, {}, &PathPose::stamp);
  return {.label = "path, 0:00 to " + MinutesAndSeconds(last.stamp - first.stamp) + " min",
          .sample_width_px = kSteps,
          .draw_sample = [](Canvas& canvas, const Eigen::Vector2d& left_px) {
            for (int i = 0; i < kSteps; ++i) {
              canvas.StrokeLine(left_px + Eigen::Vector2d(i, 0.0),
                                left_px + Eigen::Vector2d(i + 1.0, 0.0),
                                {.color = ColorAlongPath(1.0 * i / kSteps), .width_px = 4.0});
            }
          }};
}

LegendItem DeadReckonedItem(std::ptrdiff_t count, std::size_t of) {
  return {.label = "dead-reckoned (" + std::to_string(count) + " of " + std::to_string(of) + ")",
          .sample_width_px = 2.0 * kDot_px,
          .draw_sample = [](Canvas& canvas, const Eigen::Vector2d& left_px) {
            DrawDot(canvas, left_px + Eigen::Vector2d(kDot_px, 0.0));
          }};
}

LegendItem EllipseItem(double enlargement) {
  const std::string times =
      enlargement > 1.0 ? ", " + std::to_string(std::lround(enlargement)) + " times enlarged" : "";
  return {.label = "95 % ellipse" + times,
          .sample_width_px = 24.0,
          .draw_sample = [](Canvas& canvas, const Eigen::Vector2d& left_px) {
            const Points outline_px = EllipseOutline(left_px + Eigen::Vector2d(12.0, 0.0),
                                                     Eigen::Vector2d(12.0, 6.0).asDiagonal());
            canvas.FillPolygon(outline_px, kEllipseFill);
            canvas.Stroke(outline_px, kEllipseStyle);
          }};
}

Eigen::Vector2d PositionOf(const PathPose& pose) { return pose.map_robot.T_a_b.translation_m(); }
Eigen::Vector2d PositionOf(const StampedPose2& pose) { return pose.T_map_robot.translation_m(); }

bool IsDeadReckoned(const PathPose& pose) { return pose.status == StepStatus::kDeadReckoned; }

// Draws what an overlay holds on a map.
class OverlayPainter {
 public:
  OverlayPainter(const OccupancyGrid& grid, const MapView& view, const MapOverlay& overlay)
      : overlay_(overlay),
        ellipses_(EllipsesAlong(overlay.path, kApart_px / view.px_per_m())),
        enlargement_(EnlargementOf(ellipses_, view.px_per_m())),
        frame_(grid, view, Items()) {}

  void Paint() {
    frame_.canvas().Clip(frame_.map_area());
    StrokePath(overlay_.odometry, kOdometryStyle);
    StrokePath(overlay_.answered, kAnsweredStyle);
    PaintLoops();
    PaintEllipses();
    if (overlay_.truth.empty()) StrokePath(overlay_.path, kHalo);
    StrokePath(overlay_.truth, kTruthStyle);
    PaintPath();
    if (!overlay_.path.empty()) DrawStart(frame_, overlay_.path.front().map_robot.T_a_b);
    frame_.canvas().Unclip();
  }

  const Canvas& canvas() { return frame_.canvas(); }

 private:
  static constexpr double kApart_px = 70.0;

  std::vector<LegendItem> Items() const {
    std::vector<LegendItem> items;
    if (!overlay_.path.empty()) items = {TimeItem(overlay_.path), StartItem()};
    const auto lost = std::ranges::count_if(overlay_.path, IsDeadReckoned);
    if (lost > 0) items.push_back(DeadReckonedItem(lost, overlay_.path.size()));
    if (!ellipses_.empty()) items.push_back(EllipseItem(enlargement_));
    if (!overlay_.truth.empty()) items.push_back(LineItem("truth", kTruthStyle));
    if (!overlay_.odometry.empty()) items.push_back(LineItem("odometry", kOdometryStyle));
    if (!overlay_.answered.empty()) items.push_back(LineItem("as answered", kAnsweredStyle));
    const auto loops = std::ssize(overlay_.loops);
    const auto accepted = std::ranges::count(overlay_.loops, true, &LoopLine::is_accepted);
    if (accepted > 0) items.push_back(LoopsItem("loops", accepted, kLoopStyle));
    if (loops > accepted) {
      items.push_back(LoopsItem("loops not believed", loops - accepted, kRefusedStyle));
    }
    return items;
  }

  static LegendItem LoopsItem(const std::string& name,
                              std::ptrdiff_t count,
                              const LineStyle& style) {
    return LineItem(name + " (" + std::to_string(count) + ")", style);
  }

  // Those that are not believed on top: they are few, and what one looks for.
  void PaintLoops() {
    for (const bool accepted : {true, false}) {
      for (const LoopLine& loop : overlay_.loops) {
        if (loop.is_accepted != accepted) continue;
        frame_.canvas().StrokeLine(frame_.ToCanvas(loop.from_map_m),
                                   frame_.ToCanvas(loop.to_map_m),
                                   accepted ? kLoopStyle : kRefusedStyle);
      }
    }
  }

  template <class Pose>
  Points ToCanvas(std::span<const Pose> path) const {
    Points places_m;
    places_m.reserve(path.size());
    for (const Pose& pose : path) places_m.push_back(PositionOf(pose));
    return OnCanvas(frame_, places_m);
  }

  template <class Pose>
  void StrokePath(const std::vector<Pose>& path, const LineStyle& style) {
    frame_.canvas().Stroke(ToCanvas(std::span(path)), style);
  }

  // Its colour changes in steps too small to be seen.
  void PaintPath() {
    constexpr std::size_t kSteps = 250;
    const std::span path(overlay_.path);
    for (std::size_t step = 0; step < kSteps; ++step) {
      const std::size_t first = step * path.size() / kSteps;
      const std::size_t end = std::min((step + 1) * path.size() / kSteps + 1, path.size());
      if (end - first < 2) continue;
      frame_.canvas().Stroke(
          ToCanvas(path.subspan(first, end - first)),
          {.color = ColorAlongPath(static_cast<double>(step) / kSteps), .width_px = kPathWidth_px});
    }
    for (const PathPose& pose : path) {
      if (IsDeadReckoned(pose)) DrawDot(frame_.canvas(), frame_.ToCanvas(PositionOf(pose)));
    }
  }

  void PaintEllipses() {
    for (const PlacedEllipse& ellipse : ellipses_) {
      Points outline = EllipseOutline(ellipse.center_map_m, enlargement_ * ellipse.half_axes_m);
      for (Eigen::Vector2d& point : outline) point = frame_.ToCanvas(point);
      frame_.canvas().FillPolygon(outline, kEllipseFill);
      frame_.canvas().Stroke(outline, kEllipseStyle);
    }
  }

  const MapOverlay& overlay_;
  std::vector<PlacedEllipse> ellipses_;
  double enlargement_ = 1.0;
  MapFrame frame_;
};

// The view of the map, the path and the truth; odometry may go anywhere.
MapView ViewOf(const OccupancyGrid& grid, const MapOverlay& overlay) {
  Eigen::Vector2d low_m = grid.origin_map_m;
  Eigen::Vector2d high_m = grid.origin_map_m;
  const auto include = [&](const auto& pose) {
    low_m = low_m.cwiseMin(PositionOf(pose));
    high_m = high_m.cwiseMax(PositionOf(pose));
  };
  std::ranges::for_each(overlay.path, include);
  std::ranges::for_each(overlay.truth, include);
  return {grid, low_m, high_m};
}

}  // namespace

Trajectory TrajectoryOf(std::span<const PathPose> path) {
  Trajectory trajectory;
  trajectory.reserve(path.size());
  for (const PathPose& pose : path) {
    trajectory.push_back({.stamp = pose.stamp, .T_map_robot = pose.map_robot.T_a_b});
  }
  return trajectory;
}

void WriteTrajectoryPicture(const std::filesystem::path& path,
                            const OccupancyGrid& grid,
                            const MapOverlay& overlay) {
  OverlayPainter painter(grid, ViewOf(grid, overlay), overlay);
  painter.Paint();
  painter.canvas().Save(path);
}

}  // namespace qwsm::io
