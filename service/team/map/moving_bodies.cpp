// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/moving_bodies.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "qwsm/geometry/angle.hpp"
#include "service/team/map/robot_positions.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

// Robots are no larger, and what is seen beside one is so much farther off.
constexpr double kMostAcross_m = 1.0;
constexpr double kFree_m = 0.3;
constexpr std::size_t kMinBeams = 2;
// The same body is seen so near to where it was, and after no longer.
constexpr double kSameBody_m = 0.3;
constexpr Timestamp kOutOfSight = 500ms;
// It moves if it is so far from where it was a moment ago, and was half way there in between.
constexpr Timestamp kMoment = 1s;
constexpr double kMoved_m = 0.2;
constexpr double kBesideHalfWay = 0.3;
// In a moment odometry's heading errs by less; of simulated drives by 0.03 in one of a hundred.
constexpr double kTurnByOdometry_rad = 0.1;

// Successive beams that end on one surface.
struct Row {
  std::size_t first = 0;
  std::size_t last = 0;
};

bool IsHit(const LaserScan& scan, std::size_t beam) {
  return StateOf(scan.ranges_m[beam], scan.geometry) == BeamState::kHit;
}

Eigen::Vector2d EndOf(const LaserScan& scan, std::size_t beam) {
  const double bearing_rad = scan.geometry.Bearing(beam);
  return static_cast<double>(scan.ranges_m[beam]) *
         Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
}

std::vector<Row> RowsOf(const LaserScan& scan) {
  std::vector<Row> rows;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!IsHit(scan, beam)) continue;
    const bool goes_on = !rows.empty() && rows.back().last + 1 == beam &&
                         (EndOf(scan, beam) - EndOf(scan, beam - 1)).norm() < kFree_m;
    if (!goes_on) rows.push_back({.first = beam});
    rows.back().last = beam;
  }
  return rows;
}

// Whether a beam passes by what the one beside it hits.
bool PassesBy(const LaserScan& scan, std::size_t beam, std::size_t beside) {
  const float farther_m = scan.ranges_m[beam] - scan.ranges_m[beside];
  return !IsHit(scan, beam) || static_cast<double>(farther_m) > kFree_m;
}

bool IsFreeStanding(const LaserScan& scan, const Row& row) {
  if (row.first == 0 || row.last + 1 == scan.size() || row.last + 1 - row.first < kMinBeams) {
    return false;
  }
  return PassesBy(scan, row.first - 1, row.first) && PassesBy(scan, row.last + 1, row.last) &&
         (EndOf(scan, row.last) - EndOf(scan, row.first)).norm() < kMostAcross_m;
}

Eigen::Vector2d MiddleOf(const LaserScan& scan, const Row& row) {
  return 0.5 * (EndOf(scan, row.first) + EndOf(scan, row.last));
}

// How far a body has moved at least, as seen from where the robot is now. An error of odometry's
// heading turns all bodies about the robot, the farther ones by the more metres.
double Way_m(const Eigen::Vector2d& first_m, const Eigen::Vector2d& last_m) {
  const double turn_rad = std::atan2(last_m.y(), last_m.x()) - std::atan2(first_m.y(), first_m.x());
  const double left_rad = std::max(0.0, std::abs(NormalizeAngle(turn_rad)) - kTurnByOdometry_rad);
  const double squared_m2 = first_m.squaredNorm() + last_m.squaredNorm() -
                            2.0 * first_m.norm() * last_m.norm() * std::cos(left_rad);
  return std::sqrt(std::max(0.0, squared_m2));
}

}  // namespace

std::vector<Eigen::Vector2d> MovingBodies::Follow(const LaserScan& scan,
                                                  const Pose2& T_odom_robot) {
  std::erase_if(bodies_, [&](const Body& body) {
    return std::chrono::abs(scan.stamp - body.sightings.back().stamp) > kOutOfSight;
  });
  const bool is_followed = last_ && std::chrono::abs(scan.stamp - *last_) <= kOutOfSight;
  last_ = scan.stamp;
  std::vector<Eigen::Vector2d> moving_m;
  if (!is_followed) return moving_m;
  for (const Row& row : RowsOf(scan)) {
    if (!IsFreeStanding(scan, row)) continue;
    const Eigen::Vector2d p_robot_m = scan.geometry.T_robot_laser * MiddleOf(scan, row);
    Body& body = BodyAt({.stamp = scan.stamp, .p_odom_m = T_odom_robot * p_robot_m});
    body.has_moved = body.has_moved || Moves(body, T_odom_robot.translation_m());
    const bool is_known = scan.stamp - body.first_seen >= kMoment;
    if (body.has_moved || !is_known) moving_m.push_back(p_robot_m);
  }
  return moving_m;
}

void MovingBodies::Hide(double radius_m, const Pose2& T_odom_robot, LaserScan& scan) {
  HideRobots(Follow(scan, T_odom_robot), radius_m, Pose2{}, scan);
}

MovingBodies::Body& MovingBodies::BodyAt(const Sighting& seen) {
  const auto off_m = [&](const Body& body) {
    return (body.sightings.back().p_odom_m - seen.p_odom_m).norm();
  };
  auto body = std::ranges::min_element(bodies_, {}, off_m);
  if (body == bodies_.end() || off_m(*body) > kSameBody_m) {
    body = bodies_.insert(bodies_.end(), {.sightings = {}, .first_seen = seen.stamp});
  }
  std::erase_if(body->sightings, [&](const Sighting& old) {
    return std::chrono::abs(seen.stamp - old.stamp) > kMoment;
  });
  body->sightings.push_back(seen);
  return *body;
}

bool MovingBodies::Moves(const Body& body, const Eigen::Vector2d& robot_m) {
  const Eigen::Vector2d& first_m = body.sightings.front().p_odom_m;
  const Eigen::Vector2d& middle_m = body.sightings[body.sightings.size() / 2].p_odom_m;
  const Eigen::Vector2d& last_m = body.sightings.back().p_odom_m;
  const double beside_m = (middle_m - 0.5 * (first_m + last_m)).norm();
  return Way_m(first_m - robot_m, last_m - robot_m) > kMoved_m &&
         beside_m < kBesideHalfWay * (last_m - first_m).norm();
}

}  // namespace qwsm::team
