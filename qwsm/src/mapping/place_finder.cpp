// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/place_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "qwsm/mapping/surface_hold.hpp"

namespace qwsm {
namespace {

// Looks from nearer to each other see the same. The longer nothing is found, the rarer are looks.
constexpr double kBetweenLooks_m = 0.5;
constexpr double kBetweenLooks_rad = 0.5;
constexpr double kRarer = 1.2;
constexpr double kRarest = 6.0;

constexpr double kLookSpacing_m = 0.15;      // Points nearer to each other count once.
constexpr std::size_t kLookedAtPoints = 80;  // More make a search slower, not surer.
constexpr double kAroundPath_m = 1.5;        // The robot may stand a little off the mapped path.
constexpr double kMinScore = 0.3;
constexpr double kModeMargin = 0.07;

// How far a place may have moved from one look to the next beside what the local frame tells.
constexpr double kDriftSigma_m = 0.1;
constexpr double kDriftSigma_rad = 0.03;
constexpr double kDriftSigmas = 3.0;
// Places so near to each other are the same one.
constexpr double kOnePlace_m = 0.5;
constexpr double kOnePlace_rad = 0.2;

// Successive looks see much of the same: so much of what each tells is new.
constexpr double kNewInALook = 0.4;
constexpr int kMinLooks = 3;
constexpr double kMinWay_m = 1.2;
constexpr double kSureNats = 9.2;      // Wrong once in ten thousand.
constexpr double kForetoldNats = 1.0;  // Of what comes into view while a place is followed.
constexpr double kHeldPoints = 16.0;   // A fifth of all, those of any one surface not counted.
constexpr double kKnownNats = 4.6;     // Elsewhere once in a hundred.
constexpr double kForgetNats = 15.0;   // Behind the best place, or behind being elsewhere.

bool IsSamePlace(const Pose2& a, const Pose2& b) {
  return (a.translation_m() - b.translation_m()).norm() < kOnePlace_m &&
         std::abs(NormalizeAngle(a.theta_rad - b.theta_rad)) < kOnePlace_rad;
}

UncertainPose2 Around(const Pose2& T_map_robot) {
  return UncertainPose2::WithSigmas(T_map_robot, kDriftSigma_m, kDriftSigma_rad);
}

// How many places there are along a path, each at all headings.
double CountPlaces(std::span<const Eigen::Vector2d> path_m) {
  constexpr double kSide_m = 2.0 * kOnePlace_m;
  std::set<std::pair<double, double>> cells;
  for (const Eigen::Vector2d& p_m : path_m) {
    cells.emplace(std::floor(p_m.x() / kSide_m), std::floor(p_m.y() / kSide_m));
  }
  return static_cast<double>(cells.size()) * std::numbers::pi / kOnePlace_rad;
}

// What a squared sigma costs in a search is half a nat.
double NatsPerScore(std::size_t points, const CorrelativeSearchOptions& search) {
  const auto independent = static_cast<std::size_t>(search.independent_points);
  return 0.5 * static_cast<double>(std::min(points, independent)) / search.prior_cost_points;
}

}  // namespace

// A scan, and where in the map it may have been taken.
struct PlaceFinder::Sight {
  const ScanMap& map;
  std::vector<ScanPoint> points;
  std::vector<Eigen::Vector2d> positions_m;
  FoundModes modes;

  Sight(const ScanMap& in, std::span<const ScanPoint> all)
      : map(in),
        points(ThinOut(all, kLookSpacing_m, kLookedAtPoints)),
        positions_m(PositionsOf(points)) {}

  // @param known_score of the best of the places that are followed.
  void Search(const ModeSearchArea& area, double known_score) {
    modes =
        SearchModes(map.surfaces().likelihood(),
                    area,
                    positions_m,
                    {.min_score = kMinScore, .margin = kModeMargin, .known_score = known_score});
  }
};

std::string_view Name(PlaceVerdict verdict) {
  switch (verdict) {
    case PlaceVerdict::kNotFound:
      return "not found";
    case PlaceVerdict::kOneOfThese:
      return "one of these";
    case PlaceVerdict::kFound:
      return "found";
  }
  return "unknown";
}

// Where no scan was inserted or moved, the map is as it was.
const ModeSearchArea& MappedArea::Of(const ScanMap& map) {
  std::vector<Eigen::Vector2d> path_m = PathOf(map);
  if (!area_ || path_m != path_m_) {
    path_m_ = std::move(path_m);
    area_ =
        std::make_shared<const ModeSearchArea>(map.surfaces().likelihood(), path_m_, kAroundPath_m);
  }
  return *area_;
}

PlaceFinder::PlaceFinder(const MapperOptions& options)
    : locator_(options.locator), evidence_(options.free_space) {}

const PlaceBelief& PlaceFinder::Look(const ScanMap& map,
                                     std::span<const ScanPoint> points,
                                     const Pose2& T_local_robot) {
  return Look(map, area_, points, T_local_robot);
}

const PlaceBelief& PlaceFinder::Look(const ScanMap& map,
                                     MappedArea& area,
                                     std::span<const ScanPoint> points,
                                     const Pose2& T_local_robot) {
  if (map.empty() || points.empty() || !HasMovedOn(T_local_robot)) return belief_;
  Sight sight(map, points);
  if (T_local_last_) Follow(sight, T_local_last_->Inverse() * T_local_robot);
  sight.Search(area.Of(map), FollowedScore());
  AddModes(sight);
  elsewhere_nats_ = std::log(CountPlaces(area.path_m()));
  Weigh(sight, seen_.TakeNews(points, T_local_robot));
  ForgetUnlikely();
  T_local_last_ = T_local_robot;
  ++looks_;
  const bool is_promising = !hypotheses_.empty() && hypotheses_.front().nats > 0.0;
  vain_looks_ = is_promising ? 0 : vain_looks_ + 1;
  return belief_ = Belief();
}

bool PlaceFinder::HasMovedOn(const Pose2& T_local_robot) const {
  if (!T_local_last_) return true;
  const Pose2 moved = T_local_last_->Inverse() * T_local_robot;
  const double rarer = std::min(kRarest, std::pow(kRarer, vain_looks_));
  return moved.translation_m().norm() > rarer * kBetweenLooks_m ||
         std::abs(moved.theta_rad) > rarer * kBetweenLooks_rad;
}

void PlaceFinder::Follow(const Sight& sight, const Pose2& T_last_robot) {
  for (Hypothesis& one : hypotheses_) {
    one.is_new = false;
    one.way_m += T_last_robot.translation_m().norm();
    one.map_robot = Around(one.map_robot.T_a_b * T_last_robot);
    const std::optional<FoundPose> found = SearchPose(
        sight.map.surfaces().likelihood(),
        sight.positions_m,
        FlatWindow(
            one.map_robot.T_a_b, kDriftSigmas * kDriftSigma_m, kDriftSigmas * kDriftSigma_rad),
        locator_.options().search);
    one.score = found ? found->score : 0.0;
  }
}

// Of the best place, at this look.
double PlaceFinder::FollowedScore() const {
  double best = 0.0;
  for (const Hypothesis& one : hypotheses_) best = std::max(best, one.score);
  return best;
}

void PlaceFinder::AddModes(const Sight& sight) {
  const std::size_t followed = hypotheses_.size();
  for (const FoundPose& mode : sight.modes.modes) {
    const bool is_followed = std::ranges::any_of(
        std::span(hypotheses_).first(followed),
        [&](const Hypothesis& one) { return IsSamePlace(one.map_robot.T_a_b, mode.T_map_robot); });
    if (is_followed) continue;
    hypotheses_.push_back({.map_robot = Around(mode.T_map_robot), .score = mode.score});
  }
}

// For a place speaks that the scan fits there, and that it fits better than at the best of the
// places where the robot cannot have been before: that is what chance would bring.
// @param news share of the points that no look before has seen.
void PlaceFinder::Weigh(const Sight& sight, double news) {
  const double nats_per_score = NatsPerScore(sight.points.size(), locator_.options().search);
  const bool is_held = PointsHoldingWithoutAnySurface(sight.points) >= kHeldPoints;
  for (Hypothesis& one : hypotheses_) {
    double rival_score = sight.modes.floor_score;
    for (const Hypothesis& other : hypotheses_) {
      if (&other != &one && other.is_new) rival_score = std::max(rival_score, other.score);
    }
    const MatchResult match = locator_.Locate(sight.map, sight.points, one.map_robot);
    const double lead_nats = nats_per_score * (one.score - rival_score);
    const double fit_nats = evidence_.Weigh(sight.map, sight.points, match).Nats();
    one.nats += kNewInALook * (lead_nats + fit_nats);
    if (!one.is_new) one.foretold_nats += news * (lead_nats + fit_nats);
    one.is_held = is_held;
    if (lead_nats > 0.0) {
      ++one.looks;
      one.map_robot = match.pose();
    }
  }
}

// Hypotheses that have come together are one.
void PlaceFinder::ForgetUnlikely() {
  std::ranges::stable_sort(hypotheses_, std::ranges::greater{}, &Hypothesis::nats);
  std::vector<Hypothesis> likely;
  for (const Hypothesis& one : hypotheses_) {
    if (one.nats < std::max(0.0, hypotheses_.front().nats) - kForgetNats) break;
    const bool is_known = std::ranges::any_of(likely, [&](const Hypothesis& better) {
      return IsSamePlace(better.map_robot.T_a_b, one.map_robot.T_a_b);
    });
    if (!is_known) likely.push_back(one);
  }
  hypotheses_ = std::move(likely);
}

// By how much the best place leads every other one, and being elsewhere.
double PlaceFinder::LeadNats() const {
  if (hypotheses_.empty()) return 0.0;
  const double next_nats = hypotheses_.size() > 1 ? hypotheses_[1].nats : elsewhere_nats_;
  return hypotheses_.front().nats - std::max(elsewhere_nats_, next_nats);
}

bool PlaceFinder::IsFound() const {
  if (LeadNats() < kSureNats) return false;
  const Hypothesis& best = hypotheses_.front();
  return best.looks >= kMinLooks && best.way_m >= kMinWay_m &&
         (best.is_held || best.foretold_nats >= kForetoldNats);
}

PlaceBelief PlaceFinder::Belief() const {
  PlaceBelief belief;
  belief.looks = looks_;
  const double best_nats =
      hypotheses_.empty() ? elsewhere_nats_ : std::max(elsewhere_nats_, hypotheses_.front().nats);
  const double elsewhere = std::exp(elsewhere_nats_ - best_nats);
  double sum = elsewhere;
  for (const Hypothesis& one : hypotheses_) sum += std::exp(one.nats - best_nats);
  for (const Hypothesis& one : hypotheses_) {
    belief.places.push_back(
        {.map_robot = one.map_robot, .probability = std::exp(one.nats - best_nats) / sum});
  }
  if (IsFound()) {
    belief.verdict = PlaceVerdict::kFound;
  } else if (std::log(sum / elsewhere) >= kKnownNats) {
    belief.verdict = PlaceVerdict::kOneOfThese;
  }
  return belief;
}

}  // namespace qwsm
