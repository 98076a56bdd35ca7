// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace qwsm::test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::string_view kRouteMarks = "123456789abcdefghijklmn";

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double DistanceTo(const Wall& wall,
                  const Eigen::Vector2d& origin_m,
                  const Eigen::Vector2d& direction) {
  const Eigen::Vector2d along_m = wall.to_m - wall.from_m;
  const double determinant_m = Cross(direction, along_m);
  if (determinant_m == 0.0) return kNever;  // Parallel: an edge has no width.
  const Eigen::Vector2d to_wall_m = wall.from_m - origin_m;
  const double share = Cross(to_wall_m, direction) / determinant_m;
  const double distance_m = Cross(to_wall_m, along_m) / determinant_m;
  return share >= 0.0 && share <= 1.0 && distance_m >= 0.0 ? distance_m : kNever;
}

double DistanceTo(const Column& column,
                  const Eigen::Vector2d& origin_m,
                  const Eigen::Vector2d& direction) {
  const Eigen::Vector2d to_center_m = column.center_m - origin_m;
  const double nearest_m = to_center_m.dot(direction);
  const double half_chord_m2 =
      column.radius_m * column.radius_m - to_center_m.squaredNorm() + nearest_m * nearest_m;
  if (half_chord_m2 < 0.0) return kNever;
  const double distance_m = nearest_m - std::sqrt(half_chord_m2);
  return distance_m >= 0.0 ? distance_m : kNever;
}

// The cells of a drawing, row 0 at the bottom; outside all is free.
class Drawing {
 public:
  explicit Drawing(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      if (end > 0 || !rows_.empty()) rows_.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    std::ranges::reverse(rows_);
    for (const std::string& row : rows_) width_ = std::max(width_, static_cast<int>(row.size()));
  }

  int width() const { return width_; }
  int height() const { return static_cast<int>(rows_.size()); }

  char At(int x, int y) const {
    if (x < 0 || y < 0 || y >= height()) return ' ';
    const std::string& row = rows_[static_cast<std::size_t>(y)];
    return static_cast<std::size_t>(x) < row.size() ? row[static_cast<std::size_t>(x)] : ' ';
  }

  bool IsSolid(int x, int y) const { return At(x, y) == '#'; }

 private:
  std::vector<std::string> rows_;
  int width_ = 0;
};

// The walls between the solid and the free cells on either side of one grid line, each as long as
// it can be. `is_edge(i)` says whether step i of `count` steps along the line is one; `corner(i)`
// is where it begins.
template <class IsEdge, class Corner>
void AddWallsOnLine(int count, IsEdge is_edge, Corner corner, std::vector<Wall>& walls) {
  int first = 0;
  while (first < count) {
    int last = first;
    while (last < count && is_edge(last)) ++last;
    if (last > first) walls.push_back({.from_m = corner(first), .to_m = corner(last)});
    first = last + 1;
  }
}

std::vector<Wall> OutlinesOf(const Drawing& drawing, double cell_m) {
  std::vector<Wall> walls;
  for (int y = 0; y <= drawing.height(); ++y) {
    const auto is_edge = [&](int x) { return drawing.IsSolid(x, y) != drawing.IsSolid(x, y - 1); };
    const auto corner = [&](int x) { return Eigen::Vector2d(x * cell_m, y * cell_m); };
    AddWallsOnLine(drawing.width(), is_edge, corner, walls);
  }
  for (int x = 0; x <= drawing.width(); ++x) {
    const auto is_edge = [&](int y) { return drawing.IsSolid(x, y) != drawing.IsSolid(x - 1, y); };
    const auto corner = [&](int y) { return Eigen::Vector2d(x * cell_m, y * cell_m); };
    AddWallsOnLine(drawing.height(), is_edge, corner, walls);
  }
  return walls;
}

// The centres of all cells drawn as `mark`.
std::vector<Eigen::Vector2d> CentersOf(const Drawing& drawing, char mark, double cell_m) {
  std::vector<Eigen::Vector2d> centers_m;
  for (int y = 0; y < drawing.height(); ++y) {
    for (int x = 0; x < drawing.width(); ++x) {
      if (drawing.At(x, y) == mark) centers_m.emplace_back((x + 0.5) * cell_m, (y + 0.5) * cell_m);
    }
  }
  return centers_m;
}

std::vector<Eigen::Vector2d> RouteOf(const Drawing& drawing, double cell_m) {
  std::vector<Eigen::Vector2d> route_m;
  bool ended = false;
  for (const char mark : kRouteMarks) {
    const std::vector<Eigen::Vector2d> places_m = CentersOf(drawing, mark, cell_m);
    if (places_m.size() > 1 || (ended && !places_m.empty())) {
      throw std::invalid_argument(std::string("the route's point '") + mark +
                                  "' is drawn twice, or follows a missing one");
    }
    ended = places_m.empty();
    if (!ended) route_m.push_back(places_m.front());
  }
  return route_m;
}

}  // namespace

std::optional<double> CastRay(const World& world,
                              const Eigen::Vector2d& origin_m,
                              const Eigen::Vector2d& direction) {
  double nearest_m = kNever;
  for (const Wall& wall : world.walls) {
    nearest_m = std::min(nearest_m, DistanceTo(wall, origin_m, direction));
  }
  for (const Column& column : world.columns) {
    nearest_m = std::min(nearest_m, DistanceTo(column, origin_m, direction));
  }
  if (nearest_m == kNever) return std::nullopt;
  return nearest_m;
}

Scene SceneFromDrawing(std::string_view drawing, double cell_m, double column_radius_m) {
  const Drawing cells(drawing);
  Scene scene{.world = {.walls = OutlinesOf(cells, cell_m), .columns = {}},
              .route_m = RouteOf(cells, cell_m)};
  for (const Eigen::Vector2d& center_m : CentersOf(cells, 'o', cell_m)) {
    scene.world.columns.push_back({.center_m = center_m, .radius_m = column_radius_m});
  }
  return scene;
}

Scene Moved(const Scene& scene, const Pose2& T_new_old) {
  Scene moved = scene;
  for (Wall& wall : moved.world.walls) {
    wall = {.from_m = T_new_old * wall.from_m, .to_m = T_new_old * wall.to_m};
  }
  for (Column& column : moved.world.columns) column.center_m = T_new_old * column.center_m;
  for (Eigen::Vector2d& point_m : moved.route_m) point_m = T_new_old * point_m;
  return moved;
}

}  // namespace qwsm::test
