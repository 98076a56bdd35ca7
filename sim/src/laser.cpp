// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sim {

qwsm::LaserGeometry GeometryOf(const LaserOptions& options) {
  const double step_rad = options.beams > 1 ? options.field_of_view_rad / (options.beams - 1) : 0.0;
  const double first_rad = options.beams > 1 ? -0.5 * options.field_of_view_rad : 0.0;
  return {.first_bearing_rad = static_cast<float>(first_rad),
          .bearing_step_rad = static_cast<float>(step_rad),
          .range_min_m = static_cast<float>(options.range_min_m),
          .range_max_m = static_cast<float>(options.range_max_m),
          .T_robot_laser = {options.mount_x_m, options.mount_y_m, options.mount_heading_rad}};
}

Laser::Laser(const LaserOptions& options, std::uint64_t seed) : options_(options), random_(seed) {
  scan_.geometry = GeometryOf(options);
  scan_.sweep =
      std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(options.sweep_s));
}

void Laser::Begin(const PhysicsWorld& world, BodyId robot, qwsm::Timestamp now) {
  assert(!is_scanning_ && "one scan at a time");
  is_scanning_ = true;
  scan_.stamp = now;
  scan_.ranges_m.clear();
  scan_.ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  last_time_ = now;
  last_T_world_robot_ = world.PoseOf(robot);
  Continue(world, robot, now);
}

void Laser::Continue(const PhysicsWorld& world, BodyId robot, qwsm::Timestamp now) {
  const qwsm::Pose2 T_world_robot = world.PoseOf(robot);
  const auto beams = static_cast<std::size_t>(options_.beams);
  for (std::size_t beam = scan_.size(); beam < beams && TimeOf(beam) <= now; ++beam) {
    const std::chrono::duration<double> since_last = TimeOf(beam) - last_time_;
    const std::chrono::duration<double> step = now - last_time_;
    const double share = step.count() > 0.0 ? since_last / step : 1.0;
    const qwsm::Pose2 T_world_laser =
        Between(last_T_world_robot_, T_world_robot, share) * scan_.geometry.T_robot_laser;
    scan_.ranges_m.push_back(Measure(world, robot, T_world_laser, beam));
  }
  last_time_ = now;
  last_T_world_robot_ = T_world_robot;
}

std::optional<qwsm::LaserScan> Laser::Take() {
  if (!is_scanning_ || scan_.size() < static_cast<std::size_t>(options_.beams)) return std::nullopt;
  is_scanning_ = false;
  return scan_;
}

qwsm::Timestamp Laser::TimeOf(std::size_t beam) const {
  const double share = options_.beams > 1 ? static_cast<double>(beam) / (options_.beams - 1) : 0.0;
  return scan_.stamp + std::chrono::round<qwsm::Timestamp>(
                           std::chrono::duration<double>(share * options_.sweep_s));
}

float Laser::Measure(const PhysicsWorld& world,
                     BodyId robot,
                     const qwsm::Pose2& T_world_laser,
                     std::size_t beam) {
  const double bearing_rad =
      scan_.geometry.Bearing(beam) + options_.bearing_sigma_rad * standard_normal_(random_);
  return Read(world.CastRay(T_world_laser.translation_m(),
                            T_world_laser.theta_rad + bearing_rad,
                            options_.useful_range_m,
                            robot));
}

float Laser::Read(double range_m) {
  // Both numbers are drawn whatever happens, so that one beam's fate does not change the others'.
  const double noise = standard_normal_(random_);
  const bool is_lost = Uniform(random_, 0.0, 1.0) < options_.dropout_probability;
  if (is_lost || !std::isfinite(range_m)) return static_cast<float>(options_.range_max_m);
  const double sigma_m =
      std::hypot(options_.range_sigma_m, options_.range_sigma_relative * range_m);
  double reading_m = std::max(0.0, range_m + sigma_m * noise);
  if (options_.range_step_m > 0.0) {
    reading_m = options_.range_step_m * std::round(reading_m / options_.range_step_m);
  }
  return static_cast<float>(reading_m);
}

}  // namespace sim
