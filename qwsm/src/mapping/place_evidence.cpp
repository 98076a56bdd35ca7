// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/place_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace qwsm {
namespace {

constexpr double kSeenFrom_m = 10.0;        // Scans farther off see little of what one sees.
constexpr double kForgotten_m = 20.0;       // Of a robot that goes on, scans farther off.
constexpr double kPointsThatTellOne = 3.0;  // As in matching.

constexpr double kOnSurface_m = 0.05;
constexpr double kOneSurface_m = 0.15;  // Points so near to each other are of one surface.

// How a point of a scan fares at the right place and at the best wrong one: medians of single scans
// of intel, aces and mit-csail in a map of the other half of each (docs/experiments.md).
struct Fate {
  double if_right;
  double if_wrong;
  double Nats() const { return std::log(if_right / if_wrong); }
};
constexpr Fate kExplained{.if_right = 0.90, .if_wrong = 0.65};
constexpr Fate kUnexplained{.if_right = 0.06, .if_wrong = 0.20};
constexpr Fate kNotContradicted{.if_right = 0.96, .if_wrong = 0.85};
constexpr Fate kSeenThrough{.if_right = 0.04, .if_wrong = 0.15};

double Share(std::ptrdiff_t count, std::size_t of) {
  return of == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(of);
}

// Whether a scan before has put a point on the surface there.
bool IsStored(const SurfaceMap& surfaces,
              const Eigen::Vector2d& p_map_m,
              ScanId before,
              double within_m) {
  const PointQuadtree& stored = surfaces.quadtree();
  bool is_stored = false;
  stored.ForEachInRadius(p_map_m, within_m, [&](PointId id, const Eigen::Vector2d&) {
    is_stored = is_stored || stored.Scan(id) < before;
  });
  return is_stored;
}

// Whether more than one of the scans before have put a point on the surface there: who walked by
// was there for one.
bool IsConfirmed(const SurfaceMap& surfaces, const Eigen::Vector2d& p_map_m, ScanId before) {
  const PointQuadtree& stored = surfaces.quadtree();
  std::optional<ScanId> first;
  bool is_confirmed = false;
  stored.ForEachInRadius(p_map_m, kOneSurface_m, [&](PointId id, const Eigen::Vector2d&) {
    const ScanId scan = stored.Scan(id);
    if (scan >= before) return;
    is_confirmed = is_confirmed || scan != first.value_or(scan);
    first = scan;
  });
  return is_confirmed;
}

// The points of a scan for which is_there(p_map_m).
template <class IsThere>
PointsThatAgree PointsThere(std::span<const ScanPoint> points,
                            const Pose2& T_map_robot,
                            IsThere is_there) {
  const RigidTransform2 to_map(T_map_robot);
  PointsThatAgree agree;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_there(to_map * points[i].p_robot_m)) continue;
    agree.points.push_back(points[i]);
    agree.share += NewsOf(points, i);
  }
  if (!points.empty()) agree.share /= CountNews(points);
  return agree;
}

// Share of a scan that scans before have stored.
double ShareStored(const SurfaceMap& surfaces,
                   std::span<const ScanPoint> points,
                   const Pose2& T_map_robot,
                   ScanId before,
                   double within_m) {
  const auto is_stored = [&](const Eigen::Vector2d& p_map_m) {
    return IsStored(surfaces, p_map_m, before, within_m);
  };
  return PointsThere(points, T_map_robot, is_stored).share;
}

// What scans before have stored around the robot, in its frame.
std::vector<ScanPoint> StoredAround(const SurfaceMap& surfaces,
                                    const Pose2& T_map_robot,
                                    ScanId before) {
  const Eigen::Vector2d here_m = T_map_robot.translation_m();
  const Eigen::Vector2d reach_m = Eigen::Vector2d::Constant(kSeenFrom_m);
  const RigidTransform2 T_robot_map(T_map_robot.Inverse());
  const PointQuadtree& stored = surfaces.quadtree();
  std::vector<ScanPoint> around;
  stored.ForEachInBox({here_m - reach_m, here_m + reach_m},
                      [&](PointId id, const Eigen::Vector2d& p_map_m) {
                        if (stored.Scan(id) >= before) return;
                        around.push_back({.p_robot_m = T_robot_map * p_map_m,
                                          .beam_robot = Eigen::Vector2d::Zero()});
                      });
  std::vector<ScanPoint> thinned = PlaceEvidence::OneOfEachSurface(around);
  std::erase_if(thinned, [&](const ScanPoint& point) {
    return !IsConfirmed(surfaces, T_map_robot * point.p_robot_m, before);
  });
  return thinned;
}

}  // namespace

double PlaceFit::Nats() const {
  const double unexplained = std::max(0.0, 1.0 - explained - seen_through);
  return NatsWithinMap() + told * unexplained * kUnexplained.Nats();
}

double PlaceFit::NatsWithinMap() const {
  return told * (explained * kExplained.Nats() + seen_through * kSeenThrough.Nats());
}

double PlaceFit::NatsInOwnMap() const {
  const double contradicted = std::min(seen_through, 1.0 - explained);
  return told * (explained * kNotContradicted.Nats() + contradicted * kSeenThrough.Nats());
}

std::vector<ScanPoint> PlaceEvidence::OneOfEachSurface(std::span<const ScanPoint> points) {
  return ThinOut(points, kOneSurface_m);
}

double PlaceEvidence::Told(std::span<const ScanPoint> points) {
  return CountNews(points) / kPointsThatTellOne;
}

double PlaceEvidence::ToldBySurfaces(std::span<const ScanPoint> points) {
  return Told(OneOfEachSurface(points));
}

PlaceFit PlaceEvidence::Weigh(const ScanMap& map,
                              std::span<const ScanPoint> points,
                              const MatchResult& match,
                              const Counts& counts) {
  return {.told = Told(points),
          .explained = HasMatched(match) ? match.overlap : 0.0,
          .seen_through = ShareSeenThrough(map, points, match.T_ref_cur, counts)};
}

double PlaceEvidence::ExplainedBefore(const ScanMap& map,
                                      const ScanAtPlace& placed,
                                      ScanId before) {
  const std::vector<ScanPoint> thinned = OneOfEachSurface(HitsOf(placed.scan));
  return ShareStored(map.surfaces(), thinned, placed.T_map_robot, before, kOneSurface_m);
}

double PlaceEvidence::ExplainedBefore(const ScanMap& map,
                                      std::span<const ScanPoint> points,
                                      const Pose2& T_map_robot,
                                      ScanId before) {
  return ShareStored(map.surfaces(), points, T_map_robot, before, kOnSurface_m);
}

PointsThatAgree PlaceEvidence::PointsOnSurfaces(const ScanMap& map,
                                                std::span<const ScanPoint> points,
                                                const Pose2& T_map_robot) {
  return PointsThere(points, T_map_robot, [&](const Eigen::Vector2d& p_map_m) {
    return map.surfaces().quadtree().Nearest(p_map_m, kOnSurface_m).has_value();
  });
}

MutualFit PlaceEvidence::WeighBothWays(const ScanMap& map,
                                       const ScanAtPlace& placed,
                                       ScanId before) {
  const std::vector<ScanPoint> points = ToPoints(placed.scan);
  const std::vector<ScanPoint> thinned = OneOfEachSurface(points);
  const auto counts = [before](ScanId scan) { return scan < before; };
  PlaceFit of_scan{.told = Told(thinned), .explained = ExplainedBefore(map, placed, before)};
  // From afar a map that drifted sees through its own walls, too.
  of_scan.seen_through = std::min(ShareSeenThrough(map, thinned, placed.T_map_robot, counts),
                                  1.0 - of_scan.explained);
  PlaceFit of_map =
      FitOfMap(StoredAround(map.surfaces(), placed.T_map_robot, before), placed, points);
  // Where a beam ends on a surface of the map and passes another one, the map contradicts itself.
  of_map.seen_through = std::min(of_map.seen_through, 1.0 - of_scan.explained);
  return {.of_scan = of_scan, .of_map = of_map};
}

PlaceFit PlaceEvidence::FitOfMap(std::span<const ScanPoint> stored,
                                 const ScanAtPlace& placed,
                                 std::span<const ScanPoint> points) const {
  std::vector<std::uint8_t> marks(stored.size(), 0);
  FreeRangeImage(placed.scan, placed.T_map_robot, options_)
      .MarkSeenThrough(stored, placed.T_map_robot, marks);
  std::ptrdiff_t explained = 0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const auto is_there = [&](const ScanPoint& point) {
      return (point.p_robot_m - stored[i].p_robot_m).squaredNorm() < kOneSurface_m * kOneSurface_m;
    };
    if (marks[i] == 0 && std::ranges::any_of(points, is_there)) ++explained;
  }
  return {.told = Told(stored),
          .explained = Share(explained, stored.size()),
          .seen_through = Share(std::ranges::count(marks, 1), stored.size())};
}

void PlaceEvidence::ForgetFarFrom(const ScanMap& map, const Pose2& T_map_robot) {
  std::erase_if(images_, [&](const auto& image) {
    const Pose2& T_map_scan = map.scans()[image.first].map_robot.T_a_b;
    return (T_map_scan.translation_m() - T_map_robot.translation_m()).norm() > kForgotten_m;
  });
}

double PlaceEvidence::ShareSeenThrough(const ScanMap& map,
                                       std::span<const ScanPoint> points,
                                       const Pose2& T_map_robot,
                                       const Counts& counts) {
  if (points.empty()) return 0.0;
  std::vector<std::uint8_t> marks(points.size(), 0);
  for (const RelevantScan& scan : map.scans()) {
    const Pose2& T_map_scan = scan.map_robot.T_a_b;
    const double apart_m = (T_map_scan.translation_m() - T_map_robot.translation_m()).norm();
    if (apart_m > kSeenFrom_m || (counts && !counts(scan.id))) continue;
    const auto image = images_.try_emplace(scan.id, scan.scan, Pose2{}, options_).first;
    image->second.MarkSeenThrough(points, T_map_scan.Inverse() * T_map_robot, marks);
  }
  return Share(std::ranges::count(marks, 1), points.size());
}

double LeadInNats(double told, double explained, double other) {
  return PlaceFit{.told = told, .explained = explained}.Nats() -
         PlaceFit{.told = told, .explained = other}.Nats();
}

double ShareForLead(double told, double nats) { return nats / LeadInNats(told, 1.0, 0.0); }

double NatsAskedOfPlace(double sigma_m) {
  return kConvincingNats + 2.0 * std::log(std::min(1.0, sigma_m / kLookalike_m));
}

bool IsConvincinglyBetter(std::span<const ScanPoint> points, double explained, double other) {
  const double told = PlaceEvidence::Told(points);
  const double nats = PlaceFit{.told = told, .explained = explained}.Nats();
  return nats >= kConvincingNats && LeadInNats(told, explained, other) >= kConvincingNats;
}

double LeastConvincing(std::span<const ScanPoint> points, double other) {
  return other + ShareForLead(PlaceEvidence::Told(points), kConvincingNats);
}

}  // namespace qwsm
