// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/observation.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// Follows what stands free in the scans of a robot and is no larger than a person or another
/// robot. Along a corridor one that comes along is all there is to be matched with, and takes the
/// robot with it: the match alone cannot tell. Nor can odometry, for all trees seem to move where
/// wheels slip. A body moves if both say so.
class MovingBodies {
 public:
  /// A body in a scan.
  struct Seen {
    std::size_t first_beam = 0;  ///< That ends on it,
    std::size_t last_beam = 0;   ///< and the last one.
    Eigen::Vector2d p_robot_m = Eigen::Vector2d::Zero();
    bool has_background = false;  ///< Surfaces are seen behind it, on both sides.
    bool moves = false;           ///< Or has moved since it came into view.
    Timestamp followed{};         ///< For so long.
  };

  /// Takes the next scan of the robot, of any of its lasers. Nothing is followed where scans are
  /// too seldom: nothing would ever be known to stand.
  void Follow(const LaserScan& scan, const Pose2& T_odom_robot);
  /// Says where that scan was taken. @param T_map_robot as odometry tells, if nothing else is
  /// known.
  void Place(const Pose2& T_map_robot);

  /// The bodies in the last scan; whether they move is known after Place(), else as of before.
  std::vector<Seen> seen() const;
  /// Takes the next scan of the robot, as Follow().
  /// @return the same without the readings that end on what is known to move.
  Observation HiddenIn(Observation observation);
  /// Marks the points of the scan that are not known to stay: on what moves, or has just appeared
  /// before what stands. At the end of a laser's reach all that comes into view is new.
  /// @param marks one for each point, or none so far.
  void MarkPassing(std::span<const ScanPoint> points, std::vector<std::uint8_t>& marks) const;

  /// Follows a map that was corrected.
  void Move(const Pose2& T_new_old);
  /// Odometry does not go on from the last scan.
  void Forget();

 private:
  struct Sighting {
    Timestamp stamp{};
    Eigen::Vector2d p_robot_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d p_odom_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();  // Once the scan is placed.
  };
  struct Body {
    std::deque<Sighting> sightings;  // Of the last second; the newest last.
    Timestamp first_seen{};
    bool has_moved = false;
  };
  struct InScan {
    Seen seen;  // But for what is known of the body.
    std::size_t body = 0;
  };

  std::size_t BodyAt(const Sighting& seen);
  static bool Moves(const Body& body,
                    Eigen::Vector2d Sighting::*position,
                    const Eigen::Vector2d& robot_m);

  std::vector<Body> bodies_;
  std::vector<InScan> in_scan_;    // Those in the last scan.
  std::optional<Timestamp> last_;  // When it was taken,
  Eigen::Vector2d robot_odom_m_ = Eigen::Vector2d::Zero();  // and where.
};

}  // namespace qwsm
