// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/yard3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace slam6d::test {
namespace {

using sim::Uniform;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLeast_m = 1e-6;

// Windows: one for so much wall, so wide, between these heights, set back so far.
constexpr double kWindowSpacing_m = 3.3;
constexpr double kWindowWidth_m = 1.2;
constexpr double kWindowBottom_m = 1.0;
constexpr double kWindowTop_m = 2.6;
constexpr double kWindowDepth_m = 0.15;

double MeetSphere(const Eigen::Vector3d& from_center_m, const Eigen::Vector3d& d, double radius_m) {
  const double b = from_center_m.dot(d);
  const double root2 = b * b - from_center_m.squaredNorm() + radius_m * radius_m;
  const double at_m = root2 > 0.0 ? -b - std::sqrt(root2) : -1.0;
  return at_m > kLeast_m ? at_m : kNever;
}

double MeetPost(const Eigen::Vector2d& from_center_m, const sim::Ray3& ray, double radius_m) {
  const Eigen::Vector2d d = ray.direction.head<2>();
  const double a = std::max(d.squaredNorm(), 1e-12);
  const double b = from_center_m.dot(d);
  const double root2 = b * b - a * (from_center_m.squaredNorm() - radius_m * radius_m);
  const double at_m = root2 > 0.0 ? (-b - std::sqrt(root2)) / a : -1.0;
  return at_m > kLeast_m ? at_m : kNever;
}

/// Where a ray enters a box about the origin.
double MeetBox(const Eigen::Vector3d& from_m, const Eigen::Vector3d& d, const Eigen::Vector3d& h) {
  double in_m = -kNever;
  double out_m = kNever;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::abs(d(axis)) > 1e-12 ? d(axis) : 1e-12;
    const double a_m = (-h(axis) - from_m(axis)) / step;
    const double b_m = (h(axis) - from_m(axis)) / step;
    in_m = std::max(in_m, std::min(a_m, b_m));
    out_m = std::min(out_m, std::max(a_m, b_m));
  }
  return in_m < out_m && in_m > kLeast_m ? in_m : kNever;
}

bool IsWindow(double along_m, double height_m) {
  const double within_m = along_m - kWindowSpacing_m * std::floor(along_m / kWindowSpacing_m);
  return within_m < kWindowWidth_m && height_m > kWindowBottom_m && height_m < kWindowTop_m;
}

}  // namespace

Yard3::Yard3(std::uint64_t seed) {
  sim::RandomEngine random(sim::SeedFor("yard", seed));
  half_width_m_ = Uniform(random, 13.0, 16.0);
  wall_height_m_ = Uniform(random, 6.0, 9.0);
  for (int i = 0; i < 4; ++i) waves_(i) = Uniform(random, 0.0, 2.0 * std::numbers::pi);
  // Things stand within the circle of the stops, between 6 and 9.5 m off the middle, or outside.
  const auto draw_place = [&] {
    const double turn_rad = Uniform(random, 0.0, 2.0 * std::numbers::pi);
    const bool is_inside = Uniform(random, 0.0, 1.0) < 0.4;
    const double off_m =
        is_inside ? Uniform(random, 1.5, 5.0) : Uniform(random, 10.5, half_width_m_ - 1.5);
    return Eigen::Vector2d(off_m * std::cos(turn_rad), off_m * std::sin(turn_rad));
  };
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector2d at_m = draw_place();
    const Eigen::Vector3d half_m(
        Uniform(random, 0.3, 1.2), Uniform(random, 0.3, 0.8), Uniform(random, 0.3, 1.5));
    crates_.push_back({.center_m = {at_m.x(), at_m.y(), GroundM(at_m.x(), at_m.y()) + half_m.z()},
                       .half_m = half_m,
                       .heading_rad = Uniform(random, 0.0, 3.0)});
  }
  for (int i = 0; i < 6; ++i) {
    posts_.push_back({.center_m = draw_place(),
                      .radius_m = Uniform(random, 0.1, 0.35),
                      .top_m = Uniform(random, 2.0, 6.0)});
  }
  for (int i = 0; i < 6; ++i) AddTree(draw_place(), random);
}

void Yard3::AddTree(const Eigen::Vector2d& at_m, sim::RandomEngine& random) {
  const double trunk_m = Uniform(random, 2.0, 3.5);
  posts_.push_back({.center_m = at_m, .radius_m = Uniform(random, 0.1, 0.2), .top_m = trunk_m});
  for (int i = 0; i < 5; ++i) {
    crowns_.push_back({.center_m = {at_m.x() + Uniform(random, -0.9, 0.9),
                                    at_m.y() + Uniform(random, -0.9, 0.9),
                                    trunk_m + Uniform(random, -0.2, 1.4)},
                       .radius_m = Uniform(random, 0.4, 0.8)});
  }
}

double Yard3::GroundM(double x_m, double y_m) const {
  const double hills_m = 0.25 * std::sin(0.3 * x_m + waves_(0)) * std::cos(0.25 * y_m + waves_(1));
  const double ruts_m = 0.02 * std::sin(2.1 * x_m + waves_(2)) * std::sin(1.7 * y_m + waves_(3));
  return hills_m + ruts_m;
}

std::optional<double> Yard3::Cast(const sim::Ray3& ray, double max_range_m) const {
  double nearest_m = CastWalls(ray, max_range_m);
  for (const Crate& crate : crates_) {
    const double c = std::cos(crate.heading_rad);
    const double s = std::sin(crate.heading_rad);
    const auto turned = [&](const Eigen::Vector3d& v) {
      return Eigen::Vector3d(c * v.x() + s * v.y(), c * v.y() - s * v.x(), v.z());
    };
    nearest_m = std::min(
        nearest_m,
        MeetBox(turned(ray.origin_m - crate.center_m), turned(ray.direction), crate.half_m));
  }
  for (const Post& post : posts_) {
    const double at_m = MeetPost(ray.origin_m.head<2>() - post.center_m, ray, post.radius_m);
    const double height_m = ray.origin_m.z() + at_m * ray.direction.z();
    if (at_m < nearest_m && height_m < post.top_m) nearest_m = at_m;
  }
  for (const Crown& crown : crowns_) {
    nearest_m = std::min(nearest_m,
                         MeetSphere(ray.origin_m - crown.center_m, ray.direction, crown.radius_m));
  }
  nearest_m = std::min(nearest_m, CastGround(ray, std::min(nearest_m, max_range_m)));
  return nearest_m < max_range_m ? std::optional(nearest_m) : std::nullopt;
}

double Yard3::CastWalls(const sim::Ray3& ray, double max_range_m) const {
  double nearest_m = max_range_m;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = ray.direction(axis);
    if (std::abs(step) < 1e-9) continue;
    const double side_m = std::copysign(half_width_m_, step);
    const auto meet = [&](double behind_m) {
      return (side_m + std::copysign(behind_m, step) - ray.origin_m(axis)) / step;
    };
    double at_m = meet(0.0);
    const Eigen::Vector3d wall_m = ray.origin_m + at_m * ray.direction;
    if (wall_m.z() > wall_height_m_) continue;
    if (IsWindow(wall_m(1 - axis), wall_m.z())) at_m = meet(kWindowDepth_m);
    if (at_m > kLeast_m) nearest_m = std::min(nearest_m, at_m);
  }
  return nearest_m;
}

// The ground has no closed form: steps as long as the height allows, then halving.
double Yard3::CastGround(const sim::Ray3& ray, double max_range_m) const {
  constexpr int kHalvings = 25;
  const auto above_m = [&](double range_m) {
    const Eigen::Vector3d p_m = ray.origin_m + range_m * ray.direction;
    return p_m.z() - GroundM(p_m.x(), p_m.y());
  };
  double low_m = 0.0;
  while (low_m < max_range_m) {
    const double high_m = low_m + std::max(0.1, 0.5 * above_m(low_m));
    if (above_m(high_m) > 0.0) {
      low_m = high_m;
      continue;
    }
    double free_m = low_m;
    double blocked_m = high_m;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle_m = 0.5 * (free_m + blocked_m);
      (above_m(middle_m) > 0.0 ? free_m : blocked_m) = middle_m;
    }
    return blocked_m;
  }
  return kNever;
}

}  // namespace slam6d::test
