// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/mapping/scan_locator.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/mapping/seen_surfaces.hpp"
#include "qwsm/matching/mode_search.hpp"

namespace qwsm {

/// What is known of the place of a robot that nobody placed.
enum class PlaceVerdict : std::uint8_t {
  kNotFound,    ///< It may well be where the map does not reach.
  kOneOfThese,  ///< It is in the map, at one of several places.
  kFound,       ///< It is at the first of the places.
};

std::string_view Name(PlaceVerdict verdict);

/// A place where the robot may be.
struct Place {
  UncertainPose2 map_robot;  ///< At the last look.
  double probability = 0.0;
};

/// What the looks so far tell.
struct PlaceBelief {
  PlaceVerdict verdict = PlaceVerdict::kNotFound;
  std::vector<Place> places;  ///< The most probable one first; what is missing to 1 is elsewhere.
  int looks = 0;              ///< How many there were so far.
};

/// Where in a map places are looked for: around the positions of its scans. Large, and the same for
/// all who look at one map.
class MappedArea {
 public:
  /// The area of the map; made anew where scans were inserted or moved since the last call.
  const ModeSearchArea& Of(const ScanMap& map);
  /// Positions of the scans of the map, as it was at the last call.
  std::span<const Eigen::Vector2d> path_m() const { return path_m_; }

 private:
  std::vector<Eigen::Vector2d> path_m_;
  std::shared_ptr<const ModeSearchArea> area_;  // Along that; copies share it.
};

/// Finds where in a map a robot is that may be anywhere in it, or outside (global localization).
///
/// Now and then it looks around: it searches the whole map for places where the scan may have been
/// taken, follows them from look to look, and weighs for each how well the scan fits by itself, and
/// how much better than anywhere else. A place that is no more than the best of many wrong ones
/// does neither for long: the next look is best explained somewhere else. What the robot had seen
/// when it thought of a place is explained there, however often it looks: where one surface alone
/// tells that place from others, which may be a surface that the map lacks elsewhere, it is not
/// found before it has foretold what comes into view later. And the larger the map, the more has to
/// speak for a place: among many there is one that is like where the map does not reach.
class PlaceFinder {
 public:
  explicit PlaceFinder(const MapperOptions& options = {});

  /// Looks around with a scan if the robot has moved on since the last look.
  /// @param T_local_robot in a frame that drifts little between two looks.
  const PlaceBelief& Look(const ScanMap& map,
                          std::span<const ScanPoint> points,
                          const Pose2& T_local_robot);
  /// The same where many look at one map. @param area of that map alone.
  const PlaceBelief& Look(const ScanMap& map,
                          MappedArea& area,
                          std::span<const ScanPoint> points,
                          const Pose2& T_local_robot);

  const PlaceBelief& belief() const { return belief_; }
  /// Where the robot was in its own frame at the last look, which the belief is about.
  const std::optional<Pose2>& T_local_looked() const { return T_local_last_; }

 private:
  // A place of the robot, followed from look to look.
  struct Hypothesis {
    UncertainPose2 map_robot;
    double score = 0.0;  // Of the last look.
    double nats = 0.0;   // Evidence of all looks against its being elsewhere.
    // What surfaces tell for it that nobody had seen when the place was thought of.
    double foretold_nats = 0.0;
    bool is_held = false;  // In the last look, by more than one surface.
    int looks = 0;         // At which it was there.
    double way_m = 0.0;    // That it was followed for.
    bool is_new = true;    // Since the last look.
  };
  struct Sight;

  bool HasMovedOn(const Pose2& T_local_robot) const;
  void Follow(const Sight& sight, const Pose2& T_last_robot);
  double FollowedScore() const;
  void AddModes(const Sight& sight);
  void Weigh(const Sight& sight, double news);
  void ForgetUnlikely();
  double LeadNats() const;
  bool IsFound() const;
  PlaceBelief Belief() const;

  ScanLocator locator_;
  PlaceEvidence evidence_;
  MappedArea area_;                     // Of the map, where nobody else has it.
  SeenSurfaces seen_;                   // By the looks so far, in the local frame.
  std::vector<Hypothesis> hypotheses_;  // The most likely one first.
  // The robot may as well be outside the map as in it: any one place has that much against it.
  double elsewhere_nats_ = 0.0;
  std::optional<Pose2> T_local_last_;  // At the last look.
  int looks_ = 0;
  int vain_looks_ = 0;  // Since one that spoke for some place.
  PlaceBelief belief_;
};

}  // namespace qwsm
