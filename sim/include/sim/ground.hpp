// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sim {

/// What a wheel finds on one kind of ground. Coefficients are forces over the wheel's load.
struct SurfaceOptions {
  double traction = 0.8;          ///< Largest force along the wheel.
  double lateral = 0.8;           ///< Largest force across the wheel.
  double scrub = 0.0;             ///< Share by which `lateral` grows where a wheel turns in place.
  double full_slip_ratio = 0.03;  ///< Slip over rim speed at which friction is used up.
  double rolling_resistance = 0.01;
  double patchiness = 0.0;  ///< Largest relative change of friction from place to place.
};

template <class Visitor>
void Describe(Visitor& visit, SurfaceOptions& o) {
  visit("traction", o.traction, {.help = "friction along a wheel", .min = 0.01, .max = 3});
  visit("lateral", o.lateral, {.help = "friction across a wheel", .min = 0.01, .max = 3});
  visit("scrub",
        o.scrub,
        {.help = "how much more friction across a wheel that digs in by turning on the spot",
         .min = 0,
         .max = 5});
  visit(
      "full_slip_ratio",
      o.full_slip_ratio,
      {.help = "slip over rim speed at which a wheel finds no more grip", .min = 0.001, .max = 1});
  visit("rolling_resistance",
        o.rolling_resistance,
        {.help = "force that holds a rolling wheel back, over its load", .min = 0, .max = 0.5});
  visit("patchiness",
        o.patchiness,
        {.help = "largest relative change of friction between places", .min = 0, .max = 0.9});
}

enum class Surface { kFloor, kGrass };

inline std::span<const std::pair<std::string_view, Surface>> Names(Surface) {
  static constexpr std::array<std::pair<std::string_view, Surface>, 2> kNames{
      {{"floor", Surface::kFloor}, {"grass", Surface::kGrass}}};
  return kNames;
}

/// An upright rectangle with ground of its own; later regions lie on top of earlier ones.
struct GroundRegionOptions {
  Surface surface = Surface::kFloor;
  double min_x_m = 0.0;
  double min_y_m = 0.0;
  double max_x_m = 0.0;
  double max_y_m = 0.0;
};

template <class Visitor>
void Describe(Visitor& visit, GroundRegionOptions& o) {
  visit("surface", o.surface, {.help = "what lies there"});
  visit("min_x_m", o.min_x_m, {.help = "left edge", .min = -1e4, .max = 1e4});
  visit("min_y_m", o.min_y_m, {.help = "lower edge", .min = -1e4, .max = 1e4});
  visit("max_x_m", o.max_x_m, {.help = "right edge", .min = -1e4, .max = 1e4});
  visit("max_y_m", o.max_y_m, {.help = "upper edge", .min = -1e4, .max = 1e4});
}

template <class Report>
void Validate(const GroundRegionOptions& o, Report& report) {
  if (o.min_x_m >= o.max_x_m) report("min_x_m", "must be below max_x_m");
  if (o.min_y_m >= o.max_y_m) report("min_y_m", "must be below max_y_m");
}

struct GroundOptions {
  Surface everywhere = Surface::kFloor;
  std::vector<GroundRegionOptions> regions{};
  SurfaceOptions floor;
  /// Wet grass: little grip, much creep before it is used up, and turf that piles up beside a wheel
  /// that is turned on the spot.
  SurfaceOptions grass{.traction = 0.35,
                       .lateral = 0.40,
                       .scrub = 0.5,
                       .full_slip_ratio = 0.25,
                       .rolling_resistance = 0.06,
                       .patchiness = 0.3};
};

template <class Visitor>
void Describe(Visitor& visit, GroundOptions& o) {
  visit("everywhere", o.everywhere, {.help = "ground where no region says otherwise"});
  visit("regions", o.regions, {.help = "places with other ground"});
  visit("floor", o.floor, {.help = "what wheels find on floor"});
  visit("grass", o.grass, {.help = "what wheels find on grass"});
}

/// Knows what a wheel finds where it stands.
class Ground {
 public:
  Ground(GroundOptions options, std::uint64_t seed) : options_(std::move(options)), seed_(seed) {}

  /// The surface at a place, its friction scaled by the patchiness there: the same place always
  /// has the same grip, places half a metre apart hardly have anything in common.
  SurfaceOptions At(const Eigen::Vector2d& p_world_m) const;

 private:
  const SurfaceOptions& KindAt(const Eigen::Vector2d& p_world_m) const;

  GroundOptions options_;
  std::uint64_t seed_;
};

}  // namespace sim
