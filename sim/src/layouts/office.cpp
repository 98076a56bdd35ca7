// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/office.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sim {
namespace {

constexpr double kWall_m = 0.12;
constexpr double kTableLeg_m = 0.03;
constexpr double kTableLength_m = 1.6;
constexpr double kTableWidth_m = 0.8;
constexpr double kIntoRoom_m = 2.2;     // How far robots go in.
constexpr double kDoorLeaf_m = 0.05;    // Thickness.
constexpr double kAside_m = 1.5;        // Where robots stand at the end, beside the door's line.
constexpr double kFromDoor_m = 1.1;     // No door is nearer to a room's corner.
constexpr double kPersonLane_m = 0.25;  // People keep nearer to the middle than robots.

/// One room in the corridor's axes: x along it from the room's left wall, y from the middle of the
/// corridor into the room.
struct Room {
  double left_m = 0.0;
  double side = 1.0;  ///< +1 above the corridor, -1 below.
  double door_m = 0.0;

  Eigen::Vector2d At(double along_m, double inwards_m) const {
    return {left_m + along_m, side * inwards_m};
  }
};

/// What stands in a wing, put up so much farther along the corridor. Wings have no people.
SceneryOptions MovedAlong(SceneryOptions wing, double along_m) {
  for (WallOptions& wall : wing.walls) {
    wall.from_x_m += along_m;
    wall.to_x_m += along_m;
  }
  for (BoxOptions& box : wing.boxes) box.x_m += along_m;
  for (RoundOptions& round : wing.rounds) round.x_m += along_m;
  return wing;
}

/// Lays out one office.
class Builder {
 public:
  Builder(const OfficeOptions& options, RandomEngine& random) : options_(options), random_(random) {
    for (int index = 0; index < 2 * options.rooms_per_side; ++index) {
      const bool is_below = index < options.rooms_per_side;
      const int column = is_below ? index : 2 * options.rooms_per_side - 1 - index;
      wing_.push_back(
          {.left_m = column * options.room_length_m,
           .side = is_below ? -1.0 : 1.0,
           .door_m = Uniform(random, kFromDoor_m, options.room_length_m - kFromDoor_m)});
    }
    // Round the corridor once: out along the lower rooms, back along the upper ones.
    for (int wing = 0; wing < options.wings; ++wing) AddRoomsOf(wing, -1.0);
    for (int wing = options.wings - 1; wing >= 0; --wing) AddRoomsOf(wing, 1.0);
  }

  Place Build() {
    AddEnds();
    SceneryOptions ends = std::exchange(place_.scenery, {});
    for (const Room& room : wing_) {
      AddRoom(room);
      AddDoor(room);
      AddFurniture(room);
    }
    const SceneryOptions wing = std::move(place_.scenery);
    place_.scenery = std::move(ends) + wing;
    for (int index = 1; index < options_.wings; ++index) {
      place_.scenery = std::move(place_.scenery) + MovedAlong(wing, index * wing_m());
    }
    for (int index = 0; index < options_.persons; ++index) AddPerson();
    for (int index = 0; index < options_.routes; ++index) {
      const std::size_t first = rooms_.size() * static_cast<std::size_t>(index) /
                                static_cast<std::size_t>(options_.routes);
      place_.routes.push_back(RouteFrom(first));
    }
    return std::move(place_);
  }

 private:
  double corridor_m() const { return 0.5 * options_.corridor_width_m; }
  double back_m() const { return corridor_m() + options_.room_depth_m; }

  double wing_m() const { return options_.rooms_per_side * options_.room_length_m; }
  double length_m() const { return options_.wings * wing_m(); }

  void AddRoomsOf(int wing, double side) {
    for (Room room : wing_) {
      if (room.side != side) continue;
      room.left_m += wing * wing_m();
      rooms_.push_back(room);
    }
  }

  void AddWall(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
    AddWalls({{from_m.x(), from_m.y()}, {to_m.x(), to_m.y()}}, kWall_m, place_.scenery);
  }

  void AddEnds() {
    AddWall({0.0, -corridor_m()}, {0.0, corridor_m()});
    AddWall({length_m(), -corridor_m()}, {length_m(), corridor_m()});
  }

  void AddRoom(const Room& room) {
    const double length_m = options_.room_length_m;
    const double half_door_m = 0.5 * options_.door_width_m;
    AddWall(room.At(0.0, corridor_m()), room.At(room.door_m - half_door_m, corridor_m()));
    AddWall(room.At(room.door_m + half_door_m, corridor_m()), room.At(length_m, corridor_m()));
    AddWall(room.At(0.0, corridor_m()), room.At(0.0, back_m()));
    AddWall(room.At(length_m, corridor_m()), room.At(length_m, back_m()));
    AddWall(room.At(0.0, back_m()), room.At(length_m, back_m()));
  }

  /// Opened into the room by 80 to 110 degrees, out of the robots' way.
  void AddDoor(const Room& room) {
    const double opened_rad = Uniform(random_, 1.4, 1.9);
    const Eigen::Vector2d hinge_m =
        room.At(room.door_m + 0.5 * options_.door_width_m + kDoorLeaf_m, corridor_m());
    const Eigen::Vector2d leaf(std::cos(opened_rad), room.side * std::sin(opened_rad));
    const double reach_m = options_.door_width_m - 0.1;
    const Eigen::Vector2d away(reach_m * std::max(0.0, -leaf.x()), 0.0);
    AddWalls({{hinge_m.x() + away.x(), hinge_m.y()},
              {hinge_m.x() + away.x() + reach_m * leaf.x(), hinge_m.y() + reach_m * leaf.y()}},
             kDoorLeaf_m,
             place_.scenery);
  }

  void AddFurniture(const Room& room) {
    const double length_m = options_.room_length_m;
    for (int table = 0; table < options_.tables_per_room; ++table) {
      // Along the back wall, side by side, where robots do not go.
      const double slot_m = length_m / options_.tables_per_room;
      const double along_m = (table + 0.5) * slot_m + Uniform(random_, -0.2, 0.2) * slot_m * 0.5;
      const double inwards_m = back_m() - Uniform(random_, 0.7, 1.2);
      AddTable(room.At(along_m, inwards_m), Uniform(random_, -0.2, 0.2));
    }
    // A cabinet in the corner that is farther from the door.
    const bool is_left = room.door_m > 0.5 * length_m;
    const double width_m = Uniform(random_, 0.6, 1.2);
    const Eigen::Vector2d centre_m =
        room.At(is_left ? 0.35 : length_m - 0.35, corridor_m() + 0.15 + 0.5 * width_m);
    place_.scenery.boxes.push_back({.x_m = centre_m.x(),
                                    .y_m = centre_m.y(),
                                    .heading_rad = 0.0,
                                    .length_m = 0.5,
                                    .width_m = width_m});
  }

  void AddTable(const Eigen::Vector2d& centre_m, double heading_rad) {
    const qwsm::Pose2 T_world_table{centre_m.x(), centre_m.y(), heading_rad};
    for (const double x_m : {-0.5 * kTableLength_m, 0.5 * kTableLength_m}) {
      for (const double y_m : {-0.5 * kTableWidth_m, 0.5 * kTableWidth_m}) {
        const Eigen::Vector2d leg_m = T_world_table * Eigen::Vector2d(x_m, y_m);
        place_.scenery.rounds.push_back(
            {.x_m = leg_m.x(), .y_m = leg_m.y(), .radius_m = kTableLeg_m});
      }
    }
  }

  /// Up and down the corridor, with a look into one room.
  void AddPerson() {
    const auto pick = [this] {
      const auto last = static_cast<std::size_t>(rooms_.size() - 1);
      return std::uniform_int_distribution<std::size_t>(0, last)(random_);
    };
    const Room& room = rooms_[pick()];
    const auto at = [](const Eigen::Vector2d& p_m) { return WaypointOptions{p_m.x(), p_m.y()}; };
    const double start_m = Uniform(random_, 1.0, length_m() - 1.0);
    place_.scenery.persons.push_back(
        {.waypoints = {{start_m, kPersonLane_m},
                       at(room.At(room.door_m, kPersonLane_m)),
                       at(room.At(room.door_m, corridor_m() + kIntoRoom_m)),
                       at(room.At(room.door_m, kPersonLane_m)),
                       {length_m() - start_m, -kPersonLane_m}},
         .speed_mps = Uniform(random_, 0.7, 1.3)});
  }

  /// Into each room and out again, beginning in the room `first`, and back into that one at the
  /// end, where the robot stands aside for others to come.
  Route RouteFrom(std::size_t first) const {
    Route route;
    const double lane_m = 0.25 * options_.corridor_width_m;
    for (std::size_t visit = 0; visit <= rooms_.size(); ++visit) {
      const Room& room = rooms_[(first + visit) % rooms_.size()];
      const double deep_m = corridor_m() + kIntoRoom_m;
      // Keeping to the right: out along the lower side, back along the upper one.
      const Eigen::Vector2d before_m = room.At(room.door_m, lane_m);
      const Eigen::Vector2d inside_m = room.At(room.door_m, deep_m);
      if (visit > 0) route.push_back({before_m.x(), before_m.y()});
      route.push_back({inside_m.x(), inside_m.y()});
      if (visit < rooms_.size()) route.push_back({before_m.x(), before_m.y()});
    }
    const Room& last = rooms_[first];
    const double aside_m = last.door_m < 0.5 * options_.room_length_m ? kAside_m : -kAside_m;
    const Eigen::Vector2d end_m = last.At(last.door_m + aside_m, corridor_m() + kIntoRoom_m);
    route.push_back({end_m.x(), end_m.y()});
    return route;
  }

  const OfficeOptions& options_;
  RandomEngine& random_;
  std::vector<Room> wing_;   // Of the first wing.
  std::vector<Room> rooms_;  // In the order of the way.
  Place place_;
};

}  // namespace

Place MakeOffice(const OfficeOptions& options, RandomEngine& random) {
  return Builder(options, random).Build();
}

}  // namespace sim
