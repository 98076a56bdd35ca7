// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/campus.hpp"

namespace sim {
namespace {

constexpr double kStreetWaypointSpacing_m = 15.0;
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

/// The rectangle round a place, counter-clockwise and closed.
Route WayRound(const Eigen::Vector2d& centre_m, const Eigen::Vector2d& half_m) {
  const double min_x_m = centre_m.x() - half_m.x();
  const double max_x_m = centre_m.x() + half_m.x();
  const double min_y_m = centre_m.y() - half_m.y();
  const double max_y_m = centre_m.y() + half_m.y();
  return {{min_x_m, min_y_m},
          {max_x_m, min_y_m},
          {max_x_m, max_y_m},
          {min_x_m, max_y_m},
          {min_x_m, min_y_m}};
}

Eigen::Vector2d HalfBlock(const CampusOptions& options) {
  return 0.5 * Eigen::Vector2d(options.block_length_m, options.block_width_m);
}

/// From the middle of a street to its trees and posts.
Eigen::Vector2d ToKerb(const CampusOptions& options) {
  return Eigen::Vector2d::Constant(0.5 * options.street_width_m - kFromHouse_m);
}

/// Trees and lamp posts along a kerb, at uneven distances.
void AddPosts(const CampusOptions& options,
              const Route& kerb,
              RandomEngine& random,
              SceneryOptions& scenery) {
  const Route places = Refined(kerb, options.post_spacing_m);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const bool is_lamp = Uniform(random, 0.0, 1.0) < 0.4;
    const Eigen::Vector2d leg_m = places[i + 1].position_m() - places[i].position_m();
    const Eigen::Vector2d p_m = places[i].position_m() + Uniform(random, 0.0, 0.6) * leg_m;
    scenery.rounds.push_back({.x_m = p_m.x(),
                              .y_m = p_m.y(),
                              .radius_m = is_lamp ? kLampRadius_m : Uniform(random, 0.12, 0.4)});
  }
}

/// Along the outer side of the outer streets, where there are no houses.
void AddOuterPosts(const CampusOptions& options, RandomEngine& random, SceneryOptions& scenery) {
  const Eigen::Vector2d half_campus_m =
      HalfBlock(options).cwiseProduct(Eigen::Vector2d(options.columns, options.rows));
  const Route kerb = WayRound(Eigen::Vector2d::Zero(), half_campus_m + ToKerb(options));
  AddPosts(options, kerb, random, scenery);
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
      const Route kerb = WayRound(block.centre_m, HalfBlock(options) - ToKerb(options));
      AddPosts(options, kerb, random, place.scenery);
      // In the middle of the streets, back to the lower left corner.
      const Route round = WayRound(block.centre_m, HalfBlock(options));
      way.insert(way.end(), round.begin() + (index == 0 ? 0 : 1), round.end());
    }
  }
  AddOuterPosts(options, random, place.scenery);
  place.routes = {Refined(way, kStreetWaypointSpacing_m)};
  return place;
}

}  // namespace sim
