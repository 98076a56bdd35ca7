// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/moving_bodies.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "qwsm/geometry/angle.hpp"

namespace qwsm {
namespace {

using namespace std::chrono_literals;

// Bodies are no larger, and what is seen beside one is so much farther off.
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
// Who walks by is known for that after so long.
constexpr Timestamp kJustSeen = 250ms;

// Successive beams that end on one surface.
struct Row {
  std::size_t first = 0;
  std::size_t last = 0;
};

bool IsHit(const LaserScan& scan, std::size_t beam) {
  return StateOf(scan.ranges_m[beam], scan.geometry) == BeamState::kHit;
}

// Squared distance of the ends of two beams. @param cos_turn cosine of the angle between them.
double Apart_m2(const LaserScan& scan, std::size_t beam, std::size_t other, double cos_turn) {
  const auto a_m = static_cast<double>(scan.ranges_m[beam]);
  const auto b_m = static_cast<double>(scan.ranges_m[other]);
  return a_m * a_m + b_m * b_m - 2.0 * a_m * b_m * cos_turn;
}

std::vector<Row> RowsOf(const LaserScan& scan) {
  const double cos_step = std::cos(static_cast<double>(scan.geometry.bearing_step_rad));
  std::vector<Row> rows;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!IsHit(scan, beam)) continue;
    const bool goes_on = !rows.empty() && rows.back().last + 1 == beam &&
                         Apart_m2(scan, beam - 1, beam, cos_step) < kFree_m * kFree_m;
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
  const double across_rad = static_cast<double>(row.last - row.first) *
                            static_cast<double>(scan.geometry.bearing_step_rad);
  return PassesBy(scan, row.first - 1, row.first) && PassesBy(scan, row.last + 1, row.last) &&
         Apart_m2(scan, row.first, row.last, std::cos(across_rad)) < kMostAcross_m * kMostAcross_m;
}

// @pre it stands free.
bool HasBackground(const LaserScan& scan, const Row& row) {
  return IsHit(scan, row.first - 1) && IsHit(scan, row.last + 1);
}

Eigen::Vector2d EndOf(const LaserScan& scan, std::size_t beam) {
  const double bearing_rad = scan.geometry.Bearing(beam);
  return static_cast<double>(scan.ranges_m[beam]) *
         Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
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

void MovingBodies::Follow(const LaserScan& scan, const Pose2& T_odom_robot) {
  in_scan_.clear();
  std::erase_if(bodies_, [&](const Body& body) {
    return std::chrono::abs(scan.stamp - body.sightings.back().stamp) > kOutOfSight;
  });
  const bool is_followed = last_ && std::chrono::abs(scan.stamp - *last_) <= kOutOfSight;
  last_ = scan.stamp;
  robot_odom_m_ = T_odom_robot.translation_m();
  if (!is_followed) return;
  for (const Row& row : RowsOf(scan)) {
    if (!IsFreeStanding(scan, row)) continue;
    const Eigen::Vector2d p_robot_m = scan.geometry.T_robot_laser * MiddleOf(scan, row);
    in_scan_.push_back(
        {.seen = {.first_beam = row.first,
                  .last_beam = row.last,
                  .p_robot_m = p_robot_m,
                  .has_background = HasBackground(scan, row)},
         .body = BodyAt(
             {.stamp = scan.stamp, .p_robot_m = p_robot_m, .p_odom_m = T_odom_robot * p_robot_m})});
  }
}

void MovingBodies::Place(const Pose2& T_map_robot) {
  for (const InScan& one : in_scan_) {
    Body& body = bodies_[one.body];
    for (auto now = body.sightings.rbegin(); now != body.sightings.rend() && now->stamp == *last_;
         ++now) {
      now->p_map_m = T_map_robot * now->p_robot_m;
    }
    body.has_moved =
        body.has_moved || (Moves(body, &Sighting::p_odom_m, robot_odom_m_) &&
                           Moves(body, &Sighting::p_map_m, T_map_robot.translation_m()));
  }
}

std::vector<MovingBodies::Seen> MovingBodies::seen() const {
  std::vector<Seen> seen;
  seen.reserve(in_scan_.size());
  for (const InScan& one : in_scan_) {
    const Body& body = bodies_[one.body];
    seen.push_back(one.seen);
    seen.back().moves = body.has_moved;
    seen.back().followed = std::chrono::abs(*last_ - body.first_seen);
  }
  return seen;
}

// Without odometry nobody can tell a body that moves from a robot that does.
Observation MovingBodies::HiddenIn(Observation observation) {
  if (!observation.T_odom_robot) {
    Forget();
    return observation;
  }
  Follow(observation.scan, *observation.T_odom_robot);
  std::vector<float>& ranges_m = observation.scan.ranges_m;
  for (const Seen& body : seen()) {
    if (!body.moves) continue;
    const auto first = ranges_m.begin() + static_cast<std::ptrdiff_t>(body.first_beam);
    const auto last = ranges_m.begin() + static_cast<std::ptrdiff_t>(body.last_beam);
    std::fill(first, last + 1, std::numeric_limits<float>::quiet_NaN());
  }
  return observation;
}

void MovingBodies::MarkPassing(std::span<const ScanPoint> points,
                               std::vector<std::uint8_t>& marks) const {
  for (const Seen& body : seen()) {
    const bool has_just_appeared = body.followed < kJustSeen && body.has_background;
    if (!body.moves && !has_just_appeared) continue;
    marks.resize(points.size());
    const auto first =
        std::ranges::lower_bound(points, body.first_beam, {}, &ScanPoint::beam) - points.begin();
    for (auto i = static_cast<std::size_t>(first);
         i < points.size() && points[i].beam <= body.last_beam;
         ++i) {
      marks[i] = 1;
    }
  }
}

void MovingBodies::Move(const Pose2& T_new_old) {
  for (Body& body : bodies_) {
    for (Sighting& seen : body.sightings) seen.p_map_m = T_new_old * seen.p_map_m;
  }
}

void MovingBodies::Forget() {
  bodies_.clear();
  in_scan_.clear();
  last_.reset();
}

std::size_t MovingBodies::BodyAt(const Sighting& seen) {
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
  return static_cast<std::size_t>(body - bodies_.begin());
}

// In the frame of the positions. @param robot_m where the robot is there now.
bool MovingBodies::Moves(const Body& body,
                         Eigen::Vector2d Sighting::*position,
                         const Eigen::Vector2d& robot_m) {
  const Eigen::Vector2d& first_m = body.sightings.front().*position;
  const Eigen::Vector2d& middle_m = body.sightings[body.sightings.size() / 2].*position;
  const Eigen::Vector2d& last_m = body.sightings.back().*position;
  const double beside_m = (middle_m - 0.5 * (first_m + last_m)).norm();
  return Way_m(first_m - robot_m, last_m - robot_m) > kMoved_m &&
         beside_m < kBesideHalfWay * (last_m - first_m).norm();
}

}  // namespace qwsm
