// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/campus.hpp"

namespace sim {
namespace {

constexpr double kWaypointSpacing_m = 15.0;
constexpr double kLampRadius_m = 0.08;
constexpr double kFromHouse_m = 1.2;  // Of trees and posts.

/// One house, with streets all round it.
struct Block {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
};

Block BlockAt(const CampusOptions& options, int column, int row) {
  return {{(column + 0.5 - 0.5 * options.columns) * options.block_length_m,
           (row + 0.5 - 0.5 * options.rows) * options.block_width_m}};
}

/// A main house with a wing that sticks out or stays back by a random length, so that no two
/// street fronts look alike.
void AddHouse(const CampusOptions& options,
              const Block& block,
              RandomEngine& random,
              SceneryOptions& scenery) {
  const double length_m = options.block_length_m - options.street_width_m;
  const double width_m = options.block_width_m - options.street_width_m;
  const double cut_m = Uniform(random, 0.25, 0.45) * length_m;
  const double back_m = Uniform(random, 0.1, 0.4) * width_m;
  const double side = Uniform(random, 0.0, 1.0) < 0.5 ? 1.0 : -1.0;
  scenery.boxes.push_back({.x_m = block.centre_m.x() - 0.5 * cut_m,
                           .y_m = block.centre_m.y(),
                           .heading_rad = 0.0,
                           .length_m = length_m - cut_m,
                           .width_m = width_m});
  scenery.boxes.push_back({.x_m = block.centre_m.x() + 0.5 * (length_m - cut_m),
                           .y_m = block.centre_m.y() + side * 0.5 * back_m,
                           .heading_rad = 0.0,
                           .length_m = cut_m,
                           .width_m = width_m - back_m});
}

/// Trees and lamp posts on a rectangle round the house, at uneven distances.
void AddPosts(const CampusOptions& options,
              const Block& block,
              RandomEngine& random,
              SceneryOptions& scenery) {
  const double x_m = 0.5 * (options.block_length_m - options.street_width_m) + kFromHouse_m;
  const double y_m = 0.5 * (options.block_width_m - options.street_width_m) + kFromHouse_m;
  const Eigen::Vector2d c_m = block.centre_m;
  const Route round = Refined({{c_m.x() - x_m, c_m.y() - y_m},
                               {c_m.x() + x_m, c_m.y() - y_m},
                               {c_m.x() + x_m, c_m.y() + y_m},
                               {c_m.x() - x_m, c_m.y() + y_m},
                               {c_m.x() - x_m, c_m.y() - y_m}},
                              options.post_spacing_m);
  for (std::size_t i = 0; i + 1 < round.size(); ++i) {
    const bool is_lamp = Uniform(random, 0.0, 1.0) < 0.4;
    const Eigen::Vector2d leg_m = round[i + 1].position_m() - round[i].position_m();
    const Eigen::Vector2d p_m = round[i].position_m() + Uniform(random, 0.0, 0.6) * leg_m;
    scenery.rounds.push_back({.x_m = p_m.x(),
                              .y_m = p_m.y(),
                              .radius_m = is_lamp ? kLampRadius_m : Uniform(random, 0.12, 0.4)});
  }
}

/// Round the block counter-clockwise, in the middle of its streets, back to its lower left corner.
Route RoundBlock(const CampusOptions& options, const Block& block) {
  const double x_m = 0.5 * options.block_length_m;
  const double y_m = 0.5 * options.block_width_m;
  const Eigen::Vector2d c_m = block.centre_m;
  return {{c_m.x() - x_m, c_m.y() - y_m},
          {c_m.x() + x_m, c_m.y() - y_m},
          {c_m.x() + x_m, c_m.y() + y_m},
          {c_m.x() - x_m, c_m.y() + y_m},
          {c_m.x() - x_m, c_m.y() - y_m}};
}

}  // namespace

Place MakeCampus(const CampusOptions& options, RandomEngine& random) {
  Place place;
  Route way;
  for (int row = 0; row < options.rows; ++row) {
    for (int index = 0; index < options.columns; ++index) {
      // Every other row backwards: from one row to the next the way follows one street.
      const int column = row % 2 == 0 ? index : options.columns - 1 - index;
      const Block block = BlockAt(options, column, row);
      AddHouse(options, block, random, place.scenery);
      AddPosts(options, block, random, place.scenery);
      const Route round = RoundBlock(options, block);
      way.insert(way.end(), round.begin() + (index == 0 ? 0 : 1), round.end());
    }
  }
  place.routes = {Refined(way, kWaypointSpacing_m)};
  return place;
}

}  // namespace sim
