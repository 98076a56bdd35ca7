// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

struct FreeSpaceOptions {
  int scans = 10;
  double margin_m = 0.3;
  int margin_beams = 2;
  double max_moving_share = 0.3;
};

template <class Visitor>
void Describe(Visitor& visit, FreeSpaceOptions& o) {
  visit("scans",
        o.scans,
        {.help = "what ends where one of a laser's so many last scans saw through has moved there",
         .min = 0,
         .max = 1000});
  visit("margin_m",
        o.margin_m,
        {.help = "seen through is what lies this much before where a beam ended",
         .min = 0,
         .max = 10});
  visit("margin_beams",
        o.margin_beams,
        {.help = "beams on both sides of a direction that have to see through as well",
         .min = 0,
         .max = 100});
  visit("max_moving_share",
        o.max_moving_share,
        {.help = "where more of a scan seems to have moved, it is the pose that is wrong",
         .min = 0,
         .max = 1});
}

/// Which beam of a scan points in each of many directions around its laser.
class BeamsByDirection {
 public:
  static constexpr std::size_t kDirections = 1024;  ///< Of nearly equal width.

  explicit BeamsByDirection(const LaserScan& scan);

  /// Whether the beams of another scan point in the same directions.
  bool Fit(const LaserScan& scan) const;
  /// The index of the beam in each direction; the number of beams where there is none.
  std::span<const std::uint32_t, kDirections> beams() const { return beams_; }

 private:
  float first_bearing_rad_;
  float bearing_step_rad_;
  std::size_t scan_size_;
  std::array<std::uint32_t, kDirections> beams_;
};

/// Positions of points in single precision, so that many are computed with side by side.
class PointColumns {
 public:
  static constexpr std::size_t kAtATime = 32;  ///< Columns are filled up to a multiple.

  explicit PointColumns(std::span<const ScanPoint> points);

  std::size_t size() const { return size_; }
  const float* x_m() const { return x_m_.data(); }
  const float* y_m() const { return y_m_.data(); }

 private:
  std::size_t size_;
  std::vector<float> x_m_;
  std::vector<float> y_m_;
};

/// What one scan saw to be free, as a range image of one row: in each direction the range up to
/// where its beams ended. Where no beam came back, nothing is known.
class FreeRangeImage {
 public:
  /// @param beams those of the scan, if they are at hand.
  FreeRangeImage(const LaserScan& scan,
                 const Pose2& T_map_robot,
                 const FreeSpaceOptions& options,
                 std::shared_ptr<const BeamsByDirection> beams = nullptr);

  /// Marks the points that the scan saw through, with the margins of the options.
  /// @param seen_through of each point; those not seen through are left as they are.
  void MarkSeenThrough(std::span<const ScanPoint> points,
                       const Pose2& T_map_robot,
                       std::span<std::uint8_t> seen_through) const;
  void MarkSeenThrough(const PointColumns& points,
                       const RigidTransform2& T_map_robot,
                       std::span<std::uint8_t> seen_through) const;

  /// Follows a map that was moved here. @param T_new_old the old map's frame in the new one.
  void Move(const Pose2& T_new_old);

  /// Those of the scan, for others of the same laser.
  const std::shared_ptr<const BeamsByDirection>& beams() const { return beams_; }

 private:
  static constexpr std::size_t kDirections = BeamsByDirection::kDirections;

  Pose2 T_laser_map_;
  RigidTransform2 laser_map_;  // The same.
  std::shared_ptr<const BeamsByDirection> beams_;
  std::array<float, kDirections> free_m2_;  // Squared, by direction in the laser's frame.
};

/// The free space that the last few relevant scans of a laser saw, and other lasers meanwhile.
/// Points of a new scan that end there are of somebody who walked there, or another robot; in the
/// map they would be paired with where he was a moment ago and drag the pose along.
class FreeSpace {
 public:
  explicit FreeSpace(const FreeSpaceOptions& options = {}) : options_(options) {}

  const FreeSpaceOptions& options() const { return options_; }

  void Add(const LaserScan& scan, const Pose2& T_map_robot);
  void Clear() { images_.clear(); }
  /// Follows a map that was moved here. @param T_new_old the old map's frame in the new one.
  void Move(const Pose2& T_new_old);

  /// Marks those of the points that have moved. Empty if none has, or so many that the pose is
  /// wrong.
  std::vector<std::uint8_t> MovingAmong(std::span<const ScanPoint> points,
                                        const Pose2& T_map_robot) const;
  /// The points that may have stood where they are all the time.
  std::vector<ScanPoint> WithoutMoving(std::span<const ScanPoint> points,
                                       const Pose2& T_map_robot) const;

 private:
  std::shared_ptr<const BeamsByDirection> BeamsOf(const LaserScan& scan) const;

  struct Image {
    Pose2 T_robot_laser;  // Tells lasers apart.
    FreeRangeImage free;
  };

  FreeSpaceOptions options_;
  std::deque<Image> images_;  // The latest last.
};

/// The scan with the beams to marked points turned invalid. @param points those of the scan.
LaserScan WithoutMarked(LaserScan scan,
                        std::span<const ScanPoint> points,
                        std::span<const std::uint8_t> marks);

}  // namespace qwsm
