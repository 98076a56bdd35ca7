// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/match_result.hpp"

namespace qwsm {

/// How the points of a scan fare at a place of a map.
struct PlaceFit {
  double told = 0.0;          ///< How many points tell something that no other one tells.
  double explained = 0.0;     ///< Share of points that agree with a surface of the map.
  double seen_through = 0.0;  ///< Share of points that end where the map's scans saw free space.

  /// Evidence for the place in nats (log of the ratio of likelihoods). The alternative is the wrong
  /// place where the scan fits best: there two points of three agree with some surface, too, but
  /// many of the others end in free space.
  double Nats() const;
  /// The same from the points about which the map knows something: where the robot leaves the map,
  /// nothing speaks against its place.
  double NatsWithinMap() const;
  /// The same where the robot extends the map. What it put up itself explains what it sees wherever
  /// it is, so that this tells no more than that nothing contradicts; and robots that both drifted
  /// a little see through each other's walls from afar, which contradicts nothing that is
  /// explained.
  double NatsInOwnMap() const;
};

/// How a scan fares in a map, and the map in what the scan saw.
struct MutualFit {
  PlaceFit of_scan;
  PlaceFit of_map;

  /// Evidence for the place from what both looked at.
  double Nats() const { return of_scan.NatsWithinMap() + of_map.NatsWithinMap(); }
};

/// A scan at a place of a map.
struct ScanAtPlace {
  const LaserScan& scan;
  Pose2 T_map_robot;
};

/// The points of a scan that lie on surfaces of a map.
struct PointsThatAgree {
  std::vector<ScanPoint> points;
  double share = 0.0;  ///< Of the scan, by points that lie apart.
};

/// Weighs what a scan tells for and against having been taken at a place of a map.
class PlaceEvidence {
 public:
  explicit PlaceEvidence(const FreeSpaceOptions& options = {}) : options_(options) {}

  /// One point of each surface that a scan shows, where neighbours are of the same.
  static std::vector<ScanPoint> OneOfEachSurface(std::span<const ScanPoint> points);
  /// How many points tell something that no other one tells: neighbours share their errors.
  static double Told(std::span<const ScanPoint> points);
  /// The same where all points of one surface tell as much as the few by which it is met from afar.
  static double ToldBySurfaces(std::span<const ScanPoint> points);

  /// Says whether what a scan of the map saw to be free counts.
  using Counts = std::function<bool(ScanId)>;

  /// @param points of the scan, thinned out.
  /// @param match of the points at the place.
  /// @param counts all scans do, if it is none.
  PlaceFit Weigh(const ScanMap& map,
                 std::span<const ScanPoint> points,
                 const MatchResult& match,
                 const Counts& counts = {});

  /// Share of a scan that is explained by what the map had before one of its scans.
  static double ExplainedBefore(const ScanMap& map, const ScanAtPlace& placed, ScanId before);
  /// The same of points that have to lie on a surface as near as a match puts them.
  static double ExplainedBefore(const ScanMap& map,
                                std::span<const ScanPoint> points,
                                const Pose2& T_map_robot,
                                ScanId before);

  /// The points that lie on a surface as near as a match puts them.
  static PointsThatAgree PointsOnSurfaces(const ScanMap& map,
                                          std::span<const ScanPoint> points,
                                          const Pose2& T_map_robot);

  /// Weighs a scan by what the map had before one of its scans, and that by what the scan saw.
  /// What one scan alone has stored does not speak: somebody may have stood there.
  MutualFit WeighBothWays(const ScanMap& map, const ScanAtPlace& placed, ScanId before);

  /// Gives back what was kept of scans of the map far from a robot that is followed.
  void ForgetFarFrom(const ScanMap& map, const Pose2& T_map_robot);
  /// Gives back all that was kept: the map is another one, of other scans.
  void Forget() { images_.clear(); }

 private:
  double ShareSeenThrough(const ScanMap& map,
                          std::span<const ScanPoint> points,
                          const Pose2& T_map_robot,
                          const Counts& counts);
  PlaceFit FitOfMap(std::span<const ScanPoint> stored,
                    const ScanAtPlace& placed,
                    std::span<const ScanPoint> points) const;

  FreeSpaceOptions options_;
  // Of the scans that were asked for so far, each in its robot's frame: wherever these are put.
  std::map<ScanId, FreeRangeImage> images_;
};

/// By how many nats a scan that tells so much speaks for a pose, where that share of it is
/// explained, rather than for another one.
double LeadInNats(double told, double explained, double other);
/// How much more of it has to be explained for such a lead: the inverse of that.
double ShareForLead(double told, double nats);

/// Evidence that leaves a chance of 1 in 100.
inline constexpr double kConvincingNats = 4.6;

/// Evidence, in nats, that a place has to have where a robot may be so far off: the farther, the
/// more other places there are that it may be mistaken for. The best of these, beside which evidence
/// is weighed, is as near as kLookalike_m. Where less than none is asked, any place has it.
/// @param sigma_m of the robot's position relative to the surfaces of the place.
double NatsAskedOfPlace(double sigma_m);
inline constexpr double kLookalike_m = 15.0;

/// Whether a scan was taken at the pose where so much of it is explained, neither at another one nor
/// at a place that is like it, but for a chance of 1 in 100.
/// @param other share that is explained at the other pose.
bool IsConvincinglyBetter(std::span<const ScanPoint> points, double explained, double other);
/// Returns the least share that has to be explained at a pose for that.
double LeastConvincing(std::span<const ScanPoint> points, double other);

}  // namespace qwsm
