// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/rescue/rescue_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "service/io/pictures/covariance_ellipse.hpp"
#include "service/io/pictures/map_colors.hpp"
#include "service/io/rescue/searched_area.hpp"

namespace qwsm::io {
namespace {

constexpr Color kExploredGrid = FromBytes(190, 190, 191);
constexpr Color kRobotPath = FromBytes(120, 0, 140);
constexpr Color kVictimMark = FromBytes(240, 10, 10);
constexpr Color kHazardMark = FromBytes(255, 100, 30);
constexpr Color kObjectMark = FromBytes(10, 10, 240);
constexpr Color kMarkNumber = FromBytes(255, 255, 255);
constexpr Color kLegend = FromBytes(0, 50, 140);

constexpr double kChequer_m = 1.0;
constexpr double kExploredGrid_m = 0.5;
constexpr double kArrowTip_m = 0.3;
constexpr double kDiscDiameter_m = 0.35;
constexpr double kDiamondSide_m = 0.3;
constexpr double kPath_px = 3.0;
constexpr double kMarginTopLeft_m = 3.0;
constexpr double kMarginBottomRight_m = 1.0;
constexpr double kMostPixels = 400e6;

/// The cells of a grid of which something is known: from `low` to before `high`.
struct KnownCells {
  Eigen::Array2i low;
  Eigen::Array2i high;
};

KnownCells FindKnownCells(const OccupancyGrid& grid) {
  KnownCells known{.low = {grid.width, grid.height}, .high = {0, 0}};
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.At(x, y) == CellState::kUnknown) continue;
      known.low = known.low.min(Eigen::Array2i(x, y));
      known.high = known.high.max(Eigen::Array2i(x + 1, y + 1));
    }
  }
  if ((known.high <= known.low).any()) {
    throw std::runtime_error("nothing of the map is known: there is nothing to draw");
  }
  return known;
}

/// Whole cells that make up a margin.
int CellsIn(double margin_m, double cell_m) {
  return static_cast<int>(std::ceil(margin_m / cell_m - 1e-9));
}

/// The number of the square of a chequer or grid that a coordinate lies in. A coordinate on its
/// edge, but for rounding, is in the upper one.
long SquareOf(double coordinate_m, double side_m) {
  return std::lround(std::floor(coordinate_m / side_m + 1e-6));
}

/// Draws the cells and where they lie.
class CellPainter {
 public:
  explicit CellPainter(const RescueScene& scene)
      : grid_(scene.grid), px_per_cell_(scene.px_per_cell) {
    const OccupancyGrid& grid = scene.grid;
    const KnownCells known = FindKnownCells(grid);
    const int more_top_left = CellsIn(kMarginTopLeft_m, grid.cell_m);
    const int more_bottom_right = CellsIn(kMarginBottomRight_m, grid.cell_m);
    first_ = {known.low.x() - more_top_left, known.low.y() - more_bottom_right};
    count_ = known.high - known.low + more_top_left + more_bottom_right;
    if (count_.cast<double>().prod() * px_per_cell_ * px_per_cell_ > kMostPixels) {
      throw std::runtime_error("the map has too many pixels: take fewer pixels per cell");
    }
    if (scene.searched_m > 0.0) looks_ = LooksAtCells(grid, scene.paths, scene.searched_m);
  }

  GeoPicture Paint() const {
    GeoPicture picture{
        .image = {.width_px = count_.x() * px_per_cell_,
                  .height_px = count_.y() * px_per_cell_,
                  .pixels = {}},
        .pixel_m = grid_.cell_m / px_per_cell_,
        .top_left_map_m = grid_.origin_map_m +
                          grid_.cell_m * Eigen::Vector2d(first_.x(), first_.y() + count_.y())};
    picture.image.pixels.reserve(static_cast<std::size_t>(picture.image.width_px) *
                                 static_cast<std::size_t>(picture.image.height_px));
    const std::vector<Column> columns = Columns(picture);
    for (int row = 0; row < picture.image.height_px; ++row) {
      const double y_m = picture.top_left_map_m.y() - (row + 0.5) * picture.pixel_m;
      const int cell = first_.y() + count_.y() - 1 - row / px_per_cell_;
      const long line = SquareOf(y_m - 0.5 * picture.pixel_m, kExploredGrid_m);
      const bool has_line = line != SquareOf(y_m + 0.5 * picture.pixel_m, kExploredGrid_m);
      PaintRow({.cell = cell, .chequer = SquareOf(y_m, kChequer_m), .is_line = has_line},
               columns,
               picture.image.pixels);
    }
    return picture;
  }

 private:
  /// Where a row or column of pixels lies.
  struct Column {
    int cell = 0;
    long chequer = 0;
    bool is_line = false;  ///< Whether it holds a line of the grid.
  };

  std::vector<Column> Columns(const GeoPicture& picture) const {
    std::vector<Column> columns;
    for (int px = 0; px < picture.image.width_px; ++px) {
      const double x_m = picture.top_left_map_m.x() + (px + 0.5) * picture.pixel_m;
      const double half_m = 0.5 * picture.pixel_m;
      columns.push_back({.cell = first_.x() + px / px_per_cell_,
                         .chequer = SquareOf(x_m, kChequer_m),
                         .is_line = SquareOf(x_m - half_m, kExploredGrid_m) !=
                                    SquareOf(x_m + half_m, kExploredGrid_m)});
    }
    return columns;
  }

  void PaintRow(const Column& row,
                const std::vector<Column>& columns,
                std::vector<std::uint32_t>& pixels) const {
    for (const Column& column : columns) {
      const bool is_dark = (row.chequer + column.chequer) % 2 == 0;
      switch (StateAt(column.cell, row.cell)) {
        case CellState::kOccupied:
          pixels.push_back(ToPixel(map_colors::kWall));
          break;
        case CellState::kFree:
          pixels.push_back(ToPixel(row.is_line || column.is_line
                                       ? kExploredGrid
                                       : FloorColor(LooksAt(column.cell, row.cell))));
          break;
        case CellState::kUnknown:
          pixels.push_back(ToPixel(is_dark ? map_colors::kUnknownDark : map_colors::kUnknownLight));
      }
    }
  }

  /// @pre the cell is one of the grid.
  int LooksAt(int x, int y) const { return looks_.empty() ? 0 : looks_[grid_.Index(x, y)]; }
  /// The more often a place was searched, the greener it is.
  static Color FloorColor(int looks) {
    if (looks == 0) return map_colors::kFree;
    const int red_and_blue = 180 - 50 * (looks - 1) / (kMostLooks - 1);
    return FromBytes(red_and_blue, 230, red_and_blue);
  }

  CellState StateAt(int x, int y) const {
    if (x < 0 || y < 0 || x >= grid_.width || y >= grid_.height) return CellState::kUnknown;
    return grid_.At(x, y);
  }

  const OccupancyGrid& grid_;
  int px_per_cell_;
  std::vector<std::uint8_t> looks_;  // From LooksAtCells(); empty where nothing was searched.
  Eigen::Array2i first_;             // The lower left cell of the picture.
  Eigen::Array2i count_;
};

/// Draws what lies over the cells.
class MarkPainter {
 public:
  MarkPainter(GeoPicture& picture, const RescueScene& scene)
      : picture_(picture), scene_(scene), canvas_(picture.image.width_px, picture.image.height_px) {
    canvas_.Draw(picture.image, {0.0, 0.0});
  }

  void Paint() {
    for (const std::vector<Pose2>& path : scene_.paths) PaintPath(path);
    for (const std::vector<Pose2>& path : scene_.paths) {
      if (!path.empty()) PaintArrow(path.front());
    }
    for (const PointOfInterest& point : scene_.points) PaintMark(point);
    PaintLegend();
    picture_.image = canvas_.Pixels();
  }

 private:
  using Corners = std::vector<Eigen::Vector2d>;

  double Px(double length_m) const { return length_m / picture_.pixel_m; }

  void PaintPath(const std::vector<Pose2>& path) {
    Corners line_px;
    for (const Pose2& pose : path) line_px.push_back(picture_.ToPixel(pose.translation_m()));
    if (!line_px.empty()) canvas_.Stroke(line_px, {.color = kRobotPath, .width_px = kPath_px});
  }

  // Its tip lies before the robot, and its notch where the robot is.
  void PaintArrow(const Pose2& start) {
    Corners corners_px;
    for (const auto& [ahead, left] : {std::pair(1.0, 0.0), {-0.5, 0.5}, {0.0, 0.0}, {-0.5, -0.5}}) {
      const Eigen::Vector2d corner_robot_m = kArrowTip_m * Eigen::Vector2d(ahead, left);
      corners_px.push_back(picture_.ToPixel(start * corner_robot_m));
    }
    canvas_.FillPolygon(corners_px, map_colors::kStart);
  }

  void PaintMark(const PointOfInterest& point) {
    const Eigen::Vector2d center_px = picture_.ToPixel(point.p_map_m.head<2>());
    const double radius_px = 0.5 * Px(kDiscDiameter_m);
    switch (KindOf(point.type)) {
      case InterestKind::kVictim:
        PaintDisc(center_px, radius_px, kVictimMark);
        break;
      case InterestKind::kHazard:
        PaintDiamond(center_px);
        break;
      case InterestKind::kObject:
        PaintDisc(center_px, radius_px, kObjectMark);
    }
    const double letters = static_cast<double>(std::max<std::size_t>(point.id.size(), 1));
    canvas_.Write(point.id,
                  center_px,
                  {.color = kMarkNumber,
                   .size_px = 1.5 * radius_px / std::max(1.0, 0.6 * letters),
                   .alignment = TextAlignment::kCenter,
                   .bold = true});
  }

  void PaintDisc(const Eigen::Vector2d& center_px, double radius_px, const Color& color) {
    canvas_.FillPolygon(EllipseOutline(center_px, radius_px * Eigen::Matrix2d::Identity()), color);
  }

  // A square on its corner.
  void PaintDiamond(const Eigen::Vector2d& center_px) {
    const double reach_px = Px(kDiamondSide_m) / std::numbers::sqrt2;
    const Corners corners_px = {center_px + Eigen::Vector2d(reach_px, 0.0),
                                center_px + Eigen::Vector2d(0.0, reach_px),
                                center_px - Eigen::Vector2d(reach_px, 0.0),
                                center_px - Eigen::Vector2d(0.0, reach_px)};
    canvas_.FillPolygon(corners_px, kHazardMark);
  }

  // In the margin, in metres from the upper left corner.
  void PaintLegend() {
    const double size_px = std::max(Px(0.35), 9.0);
    const TextStyle style{.color = kLegend, .size_px = size_px};
    canvas_.Write(scene_.name, {Px(0.5), Px(0.5)}, style);
    Line({0.5, 1.3}, {0.5, 2.3});
    Line({0.4, 1.3}, {0.6, 1.3});
    Line({0.4, 2.3}, {0.6, 2.3});
    canvas_.Write("1m", {Px(0.65), Px(1.8)}, style);
    const Eigen::Vector2d origin_m(1.6, 2.3);
    Arrow(origin_m, {1.0, 0.0});
    Arrow(origin_m, {0.0, -1.0});
    canvas_.Write("x", {Px(2.68), Px(2.3)}, style);
    canvas_.Write("y", {Px(1.52), Px(1.08)}, style);
  }

  void Line(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
    // In the middle of pixels, or a line of one pixel would be spread over two.
    const auto middle = [&](const Eigen::Vector2d& at_m) -> Eigen::Vector2d {
      return (at_m / picture_.pixel_m).array().floor() + 0.5;
    };
    canvas_.StrokeLine(middle(from_m), middle(to_m), {.color = kLegend, .width_px = 1.0});
  }

  void Arrow(const Eigen::Vector2d& from_m, const Eigen::Vector2d& along_m) {
    const Eigen::Vector2d to_m = from_m + along_m;
    const Eigen::Vector2d across_m(-along_m.y(), along_m.x());
    Line(from_m, to_m);
    for (const double side : {-0.15, 0.15}) Line(to_m, to_m - 0.15 * along_m + side * across_m);
  }

  GeoPicture& picture_;
  const RescueScene& scene_;
  Canvas canvas_;
};

}  // namespace

GeoPicture DrawRescueMap(const RescueScene& scene) {
  GeoPicture picture = CellPainter(scene).Paint();
  MarkPainter(picture, scene).Paint();
  return picture;
}

}  // namespace qwsm::io
