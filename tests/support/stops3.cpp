// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/stops3.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "sim/layouts/layout.hpp"
#include "sim/solid_world.hpp"
#include "slam6d/mapping/octree_overlap.hpp"
#include "tests/support/yard3.hpp"

namespace slam6d::test {
namespace {

using qwsm::Pose2;
using sim::Uniform;

constexpr double kStrayShare = 0.002;
constexpr int kAttempts = 60;

double Normal(sim::RandomEngine& random, double sigma) {
  return std::normal_distribution<double>(0.0, sigma)(random);
}

/// What a scanner needs to know of a scene, and a way through it.
struct Place3 {
  std::function<std::optional<double>(const sim::Ray3&, double)> cast;
  std::function<Pose3(const Pose2&)> stand;
  sim::Route route;
};

Pose3 InSpace(const Pose2& pose) {
  return {.rotation = RotationFromRollPitchYaw({0.0, 0.0, pose.theta_rad}),
          .translation_m = {pose.x_m, pose.y_m, 0.0}};
}

/// All beams that came back; a few of them stray.
PointCloud Scan(const Place3& place,
                const Pose3& T_world_laser,
                const sim::PitchingLaserOptions& laser,
                sim::RandomEngine& random) {
  const auto spread = [](int i, int count, double opening_rad) {
    return opening_rad * (static_cast<double>(i) / (count - 1) - 0.5);
  };
  PointCloud cloud;
  for (int sweep = 0; sweep < laser.sweeps; ++sweep) {
    const Eigen::Matrix3d R_laser_sweep =
        RotationFromRollPitchYaw({0.0, spread(sweep, laser.sweeps, laser.height_rad), 0.0});
    for (int beam = 0; beam < laser.beams; ++beam) {
      const double bearing_rad = spread(beam, laser.beams, laser.width_rad);
      const Eigen::Vector3d direction =
          R_laser_sweep * Eigen::Vector3d(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
      const std::optional<double> range_m = place.cast(
          {T_world_laser.translation_m, T_world_laser.rotation * direction}, laser.max_range_m);
      if (!range_m) continue;
      const bool is_stray = Uniform(random, 0.0, 1.0) < kStrayShare;
      const double stray = is_stray ? Uniform(random, 0.2, 1.2) : 1.0;
      cloud.push_back((stray * *range_m + Normal(random, laser.noise_m)) * direction);
    }
  }
  return cloud;
}

/// Takes a scan, and lets odometry go on by what it saw of the way since the last stop: 3 % of the
/// way, and 1.5 degrees of the turn, are wrong.
void Stop(const Place3& place,
          const Pose2& T_world_robot,
          const sim::PitchingLaserOptions& laser,
          sim::RandomEngine& random,
          Stops3& stops) {
  const Pose3 T_robot_scanner{.translation_m = {0.0, 0.0, laser.mount_height_m}};
  const Pose3 T_world_scan = place.stand(T_world_robot) * T_robot_scanner;
  stops.scans.push_back(Scan(place, T_world_scan, laser, random));
  if (stops.T_world_scan.empty()) {
    stops.T_odom_scan.push_back(T_world_scan);
  } else {
    const Pose3 step = stops.T_world_scan.back().Inverse() * T_world_scan;
    const double way_m = step.translation_m.head<2>().norm();
    const double yaw_rad = RollPitchYaw(step.rotation).z();
    const Pose2 seen{step.translation_m.x() + Normal(random, 0.03 * way_m + 0.02),
                     step.translation_m.y() + Normal(random, 0.03 * way_m + 0.02),
                     yaw_rad + Normal(random, 0.026)};
    stops.T_odom_scan.push_back(stops.T_odom_scan.back() * InSpace(seen));
  }
  stops.T_world_scan.push_back(T_world_scan);
}

/// The pose of a robot of half a metre, with a heading, on the ground of the yard.
Pose3 Stand(const Yard3& yard, const Pose2& pose) {
  constexpr double kHalf_m = 0.25;
  const Eigen::Vector2d ahead(std::cos(pose.theta_rad), std::sin(pose.theta_rad));
  const auto ground_m = [&](const Eigen::Vector2d& off_m) {
    return yard.GroundM(pose.x_m + off_m.x(), pose.y_m + off_m.y());
  };
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double climb = (ground_m(kHalf_m * ahead) - ground_m(-kHalf_m * ahead)) / (2.0 * kHalf_m);
  const double lean = (ground_m(kHalf_m * left) - ground_m(-kHalf_m * left)) / (2.0 * kHalf_m);
  return {
      .rotation = RotationFromRollPitchYaw({std::atan(lean), -std::atan(climb), pose.theta_rad}),
      .translation_m = {pose.x_m, pose.y_m, ground_m({0.0, 0.0})}};
}

/// Where the n-th of so many stops on a closed way round the yard is, and where it looks.
Pose2 RoundYard(const Yard3& yard, double turn_rad) {
  const double half_x_m = 0.6 * yard.half_width_m();
  const double half_y_m = 0.53 * yard.half_width_m();
  return {half_x_m * std::cos(turn_rad),
          half_y_m * std::sin(turn_rad),
          std::atan2(half_y_m * std::cos(turn_rad), -half_x_m * std::sin(turn_rad))};
}

Place3 MakeYard(std::uint64_t seed) {
  const auto yard = std::make_shared<Yard3>(seed);
  Place3 place{
      .cast = [yard](const sim::Ray3& ray, double max_m) { return yard->Cast(ray, max_m); },
      .stand = [yard](const Pose2& pose) { return Stand(*yard, pose); },
      .route = {}};
  for (int i = 0; i <= 24; ++i) {
    const Pose2 pose = RoundYard(*yard, 2.0 * std::numbers::pi * i / 24.0);
    place.route.push_back({pose.x_m, pose.y_m});
  }
  return place;
}

Place3 MakePlace3(PlaceKind kind, std::uint64_t seed) {
  if (kind == PlaceKind::kYard) return MakeYard(seed);
  constexpr std::array<sim::LayoutKind, 6> kKinds{sim::LayoutKind::kEmpty,
                                                  sim::LayoutKind::kOffice,
                                                  sim::LayoutKind::kCorridor,
                                                  sim::LayoutKind::kCampus,
                                                  sim::LayoutKind::kPark,
                                                  sim::LayoutKind::kRubble};
  sim::LayoutOptions layout;
  layout.kind = kKinds[static_cast<std::size_t>(kind)];
  const sim::Place place = sim::MakePlace(layout, seed);
  const auto world = std::make_shared<sim::SolidWorld>(place.scenery, sim::SolidOptions{});
  return {.cast = [world](const sim::Ray3& ray, double max_m) { return world->Cast(ray, max_m); },
          .stand = [world](const Pose2& pose) { return world->terrain().Stand(pose); },
          .route = place.routes.front()};
}

/// A place on the way, so far from its beginning.
Pose2 Along(const sim::Route& route, double way_m) {
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    const Eigen::Vector2d leg_m = route[i + 1].position_m() - route[i].position_m();
    const double length_m = leg_m.norm();
    if (way_m > length_m && i + 2 < route.size()) {
      way_m -= length_m;
      continue;
    }
    const Eigen::Vector2d at_m =
        route[i].position_m() + std::min(1.0, way_m / std::max(length_m, 1e-9)) * leg_m;
    return {at_m.x(), at_m.y(), std::atan2(leg_m.y(), leg_m.x())};
  }
  return {};
}

double LengthOf(const sim::Route& route) {
  double length_m = 0.0;
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    length_m += (route[i + 1].position_m() - route[i].position_m()).norm();
  }
  return length_m;
}

double TrueOverlap(const Stops3& stops) {
  const OverlapOptions options{.max_cubes = 4000};
  const OverlapModel ref(stops.scans[0], options);
  const OverlapModel cur(stops.scans[1], options);
  const OverlapReference reference{.model = &ref, .T_map_ref = stops.T_world_scan[0]};
  return Overlap(std::span(&reference, 1), cur, stops.T_world_scan[1], options);
}

}  // namespace

double NeesOf(const Pose3& pose, const Matrix6d& covariance, const Pose3& truth) {
  const Vector6d error = Difference(pose, truth);
  return error.dot(covariance.inverse() * error) / 6.0;
}

Stops3 LoopInYard(std::uint64_t seed) {
  constexpr int kStops = 24;
  sim::RandomEngine random(sim::SeedFor("loop", seed));
  const Place3 place = MakeYard(seed);
  const Yard3 yard(seed);
  Stops3 stops;
  for (int stop = 0; stop < kStops; ++stop) {
    const double turn_rad = 2.0 * std::numbers::pi * stop / (kStops - 2);
    Stop(place, RoundYard(yard, turn_rad), {}, random, stops);
  }
  return stops;
}

Stops3 DriveAlong(PlaceKind kind, std::uint64_t seed, int stops, double step_m) {
  constexpr double kLookAside_rad = 0.15;
  sim::RandomEngine random(sim::SeedFor("drive", seed));
  const Place3 place = MakePlace3(kind, seed);
  const double length_m = LengthOf(place.route);
  const double first_m = Uniform(random, 0.0, std::max(0.0, length_m - stops * step_m));
  const sim::PitchingLaserOptions laser{.beams = 181, .sweeps = 128};
  Stops3 drive;
  for (int stop = 0; stop < stops; ++stop) {
    Pose2 pose = Along(place.route, std::min(first_m + stop * step_m, length_m));
    pose.theta_rad += Normal(random, kLookAside_rad);
    Stop(place, pose, laser, random, drive);
  }
  return drive;
}

std::optional<ScanPair3> DrawPair(PlaceKind kind,
                                  std::uint64_t seed,
                                  double least_overlap,
                                  double largest_overlap) {
  sim::RandomEngine random(sim::SeedFor("pair", seed));
  const Place3 place = MakePlace3(kind, seed);
  const double length_m = LengthOf(place.route);
  const sim::PitchingLaserOptions laser{.beams = 181, .sweeps = 128};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const double first_m = Uniform(random, 0.0, length_m);
    const double apart_m = Uniform(random, 0.3, 8.0);
    const double turn_rad = Uniform(random, -0.8, 0.8);
    ScanPair3 pair;
    Stop(place, Along(place.route, first_m), laser, random, pair.stops);
    Pose2 second = Along(place.route, std::min(first_m + apart_m, length_m));
    second.theta_rad += turn_rad;
    Stop(place, second, laser, random, pair.stops);
    pair.overlap = TrueOverlap(pair.stops);
    if (pair.overlap >= least_overlap && pair.overlap <= largest_overlap) return pair;
  }
  return std::nullopt;
}

}  // namespace slam6d::test
