// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ray casting against an oracle that shares nothing with Box2D: every disc and every side of every
// box is intersected with the ray in double precision.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/physics_world.hpp"
#include "sim/random.hpp"

namespace sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct PlacedDisc {
  Eigen::Vector2d centre_m;
  double radius_m;
};

struct PlacedBox {
  qwsm::Pose2 T_world_box;
  Rectangle size;
};

struct Ray {
  Eigen::Vector2d from_m;
  Eigen::Vector2d direction;
};

double Distance(const Ray& ray, const PlacedDisc& disc) {
  const Eigen::Vector2d offset_m = ray.from_m - disc.centre_m;
  const double b = offset_m.dot(ray.direction);
  const double c = offset_m.squaredNorm() - disc.radius_m * disc.radius_m;
  if (c < 0.0 || b * b < c || b > 0.0) return kNever;
  return -b - std::sqrt(b * b - c);
}

double DistanceToSide(const Ray& ray, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  Eigen::Matrix2d A;
  A << ray.direction, from_m - to_m;
  if (std::abs(A.determinant()) < 1e-12) return kNever;
  const Eigen::Vector2d solution = A.inverse() * (from_m - ray.from_m);
  const bool is_on_side = solution.y() >= 0.0 && solution.y() <= 1.0;
  return is_on_side && solution.x() >= 0.0 ? solution.x() : kNever;
}

double Distance(const Ray& ray, const PlacedBox& box) {
  const double x_m = 0.5 * box.size.length_m;
  const double y_m = 0.5 * box.size.width_m;
  const std::array<Eigen::Vector2d, 4> corners_box{
      Eigen::Vector2d{x_m, y_m}, {-x_m, y_m}, {-x_m, -y_m}, {x_m, -y_m}};
  const Eigen::Vector2d p_box = box.T_world_box.Inverse() * ray.from_m;
  if (std::abs(p_box.x()) < x_m && std::abs(p_box.y()) < y_m) return kNever;
  double nearest_m = kNever;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d from_m = box.T_world_box * corners_box[i];
    const Eigen::Vector2d to_m = box.T_world_box * corners_box[(i + 1) % 4];
    nearest_m = std::min(nearest_m, DistanceToSide(ray, from_m, to_m));
  }
  return nearest_m;
}

/// The same random things as a world and as lists.
class RandomWorld {
 public:
  RandomWorld(std::uint64_t seed, double extent_m)
      : random_(seed), extent_m_(extent_m), robot_(world_.AddDriven(Disc{0.01}, {}, 1.0)) {
    for (int i = 0; i < 40; ++i) {
      discs_.push_back({Place(), Uniform(random_, 0.02, 1.0)});
      world_.AddFixed(Disc{discs_.back().radius_m},
                      {discs_.back().centre_m.x(), discs_.back().centre_m.y(), 0.0});
      const Eigen::Vector2d centre_m = Place();
      boxes_.push_back({{centre_m.x(), centre_m.y(), Uniform(random_, -3.0, 3.0)},
                        {Uniform(random_, 0.05, 5.0), Uniform(random_, 0.05, 1.0)}});
      world_.AddFixed(boxes_.back().size, boxes_.back().T_world_box);
    }
  }

  Eigen::Vector2d Place() {
    const double x_m = Uniform(random_, -extent_m_, extent_m_);
    const double y_m = Uniform(random_, -extent_m_, extent_m_);
    return {x_m, y_m};
  }

  double Heading() { return Uniform(random_, -std::numbers::pi, std::numbers::pi); }

  double ByOracle(const Eigen::Vector2d& from_m, double direction_rad, double length_m) const {
    const Ray ray{from_m, {std::cos(direction_rad), std::sin(direction_rad)}};
    double nearest_m = kNever;
    for (const PlacedDisc& disc : discs_) nearest_m = std::min(nearest_m, Distance(ray, disc));
    for (const PlacedBox& box : boxes_) nearest_m = std::min(nearest_m, Distance(ray, box));
    return nearest_m <= length_m ? nearest_m : kNever;
  }

  double ByWorld(const Eigen::Vector2d& from_m, double direction_rad, double length_m) const {
    return world_.CastRay(from_m, direction_rad, length_m, robot_);
  }

 private:
  RandomEngine random_;
  double extent_m_;
  PhysicsWorld world_;
  BodyId robot_;
  std::vector<PlacedDisc> discs_;
  std::vector<PlacedBox> boxes_;
};

/// How far rays may end from where the oracle says, for nearly all rays of a world of this extent.
void ExpectRaysAsByOracle(double extent_m, double tolerance_m) {
  int rays = 0;
  int different = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomWorld world(seed, extent_m);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector2d from_m = world.Place();
      const double direction_rad = world.Heading();
      const double expected_m = world.ByOracle(from_m, direction_rad, 80.0);
      const double range_m = world.ByWorld(from_m, direction_rad, 80.0);
      const bool is_same = std::isinf(expected_m) ? std::isinf(range_m)
                                                  : std::abs(range_m - expected_m) <= tolerance_m;
      ++rays;
      different += is_same ? 0 : 1;
    }
  }
  // A ray that passes a box's corner by less than the rounding of its coordinates, or along its
  // side, may fall on either side of it.
  EXPECT_LE(different, rays / 2000) << "of " << rays;
}

TEST(CastRay, AgreesWithTheOracleInARoom) { ExpectRaysAsByOracle(10.0, 1e-4); }

TEST(CastRay, AgreesWithTheOracleInAPark) { ExpectRaysAsByOracle(60.0, 3e-4); }

TEST(CastRay, AgreesWithTheOracleOnACampus) { ExpectRaysAsByOracle(300.0, 2e-3); }

}  // namespace
}  // namespace sim
