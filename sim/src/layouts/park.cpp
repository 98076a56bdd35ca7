// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/park.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sim {
namespace {

constexpr double kPathWaypointSpacing_m = 8.0;
constexpr double kNearestGroup_m = 4.0;  // From the way to the middle of a group of trees.
constexpr double kFarthestGroup_m = 8.0;
constexpr double kBetweenTrunks_m = 1.2;
constexpr double kNearestTree_m = 6.0;  // A single tree is planted at least so far ahead.
constexpr double kLonelyBefore = 0.7;   // Share of the lonely stretch that lies before the turn.
constexpr int kPlantingAttempts = 300;
constexpr int kLayouts = 20;  // Tried, of which the best is taken.
constexpr int kSpare = 0;     // Trees a lonely place may have at the edge of its view.

/// Bottom right, bottom left, top left, top right, and a little over the start: when the robot
/// looks along its first metres again the loop is closed.
Route Loop(const ParkOptions& options, const Eigen::Vector2d& sharp_turn_m) {
  const double right = options.width_m - 6.0;
  const double top = options.height_m - 6.0;
  return {{right, 5.0},
          {10.0, 5.0},
          {6.0, 8.0},
          {5.0, 13.0},
          {5.0, top - 10.0},
          {7.0, top - 5.0},
          {12.0, top - 2.0},
          {0.5 * options.width_m, top - 2.0},
          {sharp_turn_m.x(), sharp_turn_m.y()},
          {right - 2.0, 0.5 * options.height_m},
          {right, 7.0},
          {right - 3.0, 5.0},
          {right - 6.0, 5.0}};
}

/// What a driver looking along the robot can see.
struct View {
  double range_m = 0.0;
  double half_angle_rad = 0.0;
};

constexpr View kView{20.0, qwsm::DegreesToRadians(90.0)};
// What is in here is also seen by a driver who does not quite keep to the way.
constexpr View kSureView{16.0, qwsm::DegreesToRadians(75.0)};

bool IsInView(const RoundOptions& tree, const qwsm::Pose2& T_world_robot, const View& view) {
  const Eigen::Vector2d way_m = Eigen::Vector2d(tree.x_m, tree.y_m) - T_world_robot.translation_m();
  if (way_m.squaredNorm() > view.range_m * view.range_m) return false;
  const double bearing_rad =
      qwsm::NormalizeAngle(std::atan2(way_m.y(), way_m.x()) - T_world_robot.theta_rad);
  return std::abs(bearing_rad) < view.half_angle_rad;
}

int CountInView(const std::vector<RoundOptions>& trees,
                const qwsm::Pose2& T_world_robot,
                const View& view) {
  return static_cast<int>(std::ranges::count_if(
      trees, [&](const RoundOptions& tree) { return IsInView(tree, T_world_robot, view); }));
}

/// A pose on the way, and how many trees are to be in view from there.
struct Outlook {
  qwsm::Pose2 T_world_robot;
  int min_trees = 0;  ///< In kSureView.
  int max_trees = 0;  ///< In kView.
};

/// Plants trees one by one where they are clear of the way and of each other, and wanted.
class Planter {
 public:
  Planter(const ParkOptions& options,
          const Route& route,
          const std::vector<Outlook>& outlooks,
          RandomEngine& random)
      : options_(options), route_(route), outlooks_(outlooks), random_(random) {}

  void PlantGroup(const Eigen::Vector2d& middle_m) {
    PlantNear(middle_m, options_.group_radius_m, options_.trees_per_group);
    in_groups_ = trees_.size();
  }

  /// Plants single trees ahead until enough can be seen.
  void PlantInViewOf(const Outlook& outlook) {
    for (int attempt = 0; attempt < kPlantingAttempts && !IsSatisfied(outlook); ++attempt) {
      const double bearing_rad =
          Uniform(random_, -kSureView.half_angle_rad, kSureView.half_angle_rad);
      const double range_m = Uniform(random_, kNearestTree_m, kSureView.range_m);
      const Eigen::Vector2d p_robot_m =
          range_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
      PlantAt(outlook.T_world_robot * p_robot_m);
    }
  }

  /// Fells single trees that are not needed for that: later ones often serve earlier poses too.
  void FellSpare() {
    for (std::size_t i = in_groups_; i < trees_.size();) {
      const RoundOptions tree = trees_[i];
      const auto satisfied = SatisfiedOutlooks();
      trees_.erase(trees_.begin() + static_cast<std::ptrdiff_t>(i));
      if (SatisfiedOutlooks() == satisfied) continue;
      trees_.insert(trees_.begin() + static_cast<std::ptrdiff_t>(i), tree);
      ++i;
    }
  }

  std::ptrdiff_t SatisfiedOutlooks() const {
    return std::ranges::count_if(outlooks_,
                                 [this](const Outlook& outlook) { return IsSatisfied(outlook); });
  }

  const std::vector<RoundOptions>& trees() const { return trees_; }

 private:
  bool IsSatisfied(const Outlook& outlook) const {
    return CountInView(trees_, outlook.T_world_robot, kSureView) >= outlook.min_trees;
  }

  /// Plants so many trees within `radius_m` of the middle, or fewer where there is no more room.
  void PlantNear(const Eigen::Vector2d& middle_m, double radius_m, int trees) {
    for (int attempt = 0; attempt < kPlantingAttempts && trees > 0; ++attempt) {
      const double direction_rad = Uniform(random_, 0.0, 2.0 * std::numbers::pi);
      const double distance_m = radius_m * std::sqrt(Uniform(random_, 0.0, 1.0));
      const Eigen::Vector2d way(std::cos(direction_rad), std::sin(direction_rad));
      if (PlantAt(middle_m + distance_m * way)) --trees;
    }
  }

  /// Returns whether a tree may stand there.
  bool PlantAt(const Eigen::Vector2d& p_m) {
    const RoundOptions tree{
        .x_m = p_m.x(),
        .y_m = p_m.y(),
        .radius_m = Uniform(random_, options_.min_trunk_radius_m, options_.max_trunk_radius_m)};
    if (!IsFree(tree) || IsTooMuch(tree)) return false;
    trees_.push_back(tree);
    return true;
  }

  bool IsFree(const RoundOptions& tree) const {
    const Eigen::Vector2d p_m(tree.x_m, tree.y_m);
    const bool is_inside = tree.x_m > 0.0 && tree.x_m < options_.width_m && tree.y_m > 0.0 &&
                           tree.y_m < options_.height_m;
    if (!is_inside) return false;
    if (DistanceToRoute(p_m, route_) < options_.clearance_m + tree.radius_m) return false;
    return std::ranges::none_of(trees_, [&](const RoundOptions& other) {
      return (p_m - Eigen::Vector2d(other.x_m, other.y_m)).norm() < kBetweenTrunks_m;
    });
  }

  /// Whether a place that is to be lonely would not be so any more.
  bool IsTooMuch(const RoundOptions& tree) const {
    return std::ranges::any_of(outlooks_, [&](const Outlook& outlook) {
      return IsInView(tree, outlook.T_world_robot, kView) &&
             CountInView(trees_, outlook.T_world_robot, kView) >= outlook.max_trees;
    });
  }

  const ParkOptions& options_;
  const Route& route_;
  const std::vector<Outlook>& outlooks_;
  RandomEngine& random_;
  std::vector<RoundOptions> trees_;  ///< Those of groups first.
  std::size_t in_groups_ = 0;
};

/// A point beside the middle of leg `index` of the route, on a random side of it.
Eigen::Vector2d Beside(const Route& route, std::size_t index, RandomEngine& random) {
  const Eigen::Vector2d from_m = route[index].position_m();
  const Eigen::Vector2d to_m = route[index + 1].position_m();
  const Eigen::Vector2d along = (to_m - from_m).normalized();
  const Eigen::Vector2d left(-along.y(), along.x());
  const double side = Uniform(random, 0.0, 1.0) < 0.5 ? 1.0 : -1.0;
  return 0.5 * (from_m + to_m) + side * Uniform(random, kNearestGroup_m, kFarthestGroup_m) * left;
}

/// Groups at even distances along the way, each with a random offset of up to a quarter of one.
void PlantGroups(Planter& planter,
                 const ParkOptions& options,
                 const Route& route,
                 RandomEngine& random) {
  const double legs_per_group = static_cast<double>(route.size() - 1) / options.groups;
  for (int group = 0; group < options.groups; ++group) {
    const double leg = (group + Uniform(random, 0.25, 0.75)) * legs_per_group;
    planter.PlantGroup(Beside(route, static_cast<std::size_t>(leg), random));
  }
}

/// The length of the way to each of its way points.
std::vector<double> LengthsTo(const Route& route) {
  std::vector<double> lengths_m{0.0};
  for (std::size_t i = 1; i < route.size(); ++i) {
    lengths_m.push_back(lengths_m.back() +
                        (route[i].position_m() - route[i - 1].position_m()).norm());
  }
  return lengths_m;
}

/// Poses on the way: at its beginning, and at each way point before, in and after its turn.
std::vector<Outlook> OutlooksAlong(const Route& route,
                                   const ParkOptions& options,
                                   const Eigen::Vector2d& sharp_turn_m) {
  const auto turn = std::ranges::min_element(
      route, {}, [&](const WaypointOptions& p) { return (p.position_m() - sharp_turn_m).norm(); });
  const std::vector<double> lengths_m = LengthsTo(route);
  const double turn_at_m = lengths_m[static_cast<std::size_t>(turn - route.begin())];
  const double lonely_m = options.lonely_share * lengths_m.back();
  const auto outlook = [&](std::size_t i, double heading_rad) {
    const double after_turn_m = lengths_m[i] - turn_at_m;
    const bool is_lonely = after_turn_m >= -kLonelyBefore * lonely_m &&
                           after_turn_m <= (1.0 - kLonelyBefore) * lonely_m;
    return Outlook{
        .T_world_robot = {route[i].x_m, route[i].y_m, qwsm::NormalizeAngle(heading_rad)},
        .min_trees = is_lonely ? options.lonely_in_view : options.usual_in_view,
        .max_trees = is_lonely ? options.lonely_in_view + kSpare : std::numeric_limits<int>::max()};
  };
  std::vector<Outlook> outlooks{outlook(0, StartOf(route).theta_rad)};
  for (std::size_t i = 1; i + 1 < route.size(); ++i) {
    const double before_rad = StartOf({route[i - 1], route[i]}).theta_rad;
    const double turn_rad =
        qwsm::NormalizeAngle(StartOf({route[i], route[i + 1]}).theta_rad - before_rad);
    for (const double share : {0.0, 0.5, 1.0}) {
      outlooks.push_back(outlook(i, before_rad + share * turn_rad));
    }
  }
  return outlooks;
}

}  // namespace

Place MakePark(const ParkOptions& options, RandomEngine& random) {
  const Eigen::Vector2d sharp_turn_m(options.width_m - 8.0, options.height_m - 7.0);
  const Route route = Refined(Loop(options, sharp_turn_m), kPathWaypointSpacing_m);
  const std::vector<Outlook> outlooks = OutlooksAlong(route, options, sharp_turn_m);
  std::vector<RoundOptions> trees;
  std::ptrdiff_t most_satisfied = -1;
  for (int layout = 0; layout < kLayouts; ++layout) {
    Planter planter(options, route, outlooks, random);
    PlantGroups(planter, options, route, random);
    // The lonely ones first: what they see must not be too much.
    for (const Outlook& outlook : outlooks) {
      if (outlook.min_trees == options.lonely_in_view) planter.PlantInViewOf(outlook);
    }
    for (const Outlook& outlook : outlooks) planter.PlantInViewOf(outlook);
    planter.FellSpare();
    if (planter.SatisfiedOutlooks() <= most_satisfied) continue;
    most_satisfied = planter.SatisfiedOutlooks();
    trees = planter.trees();
  }
  return {.scenery = {.walls = {}, .boxes = {}, .rounds = trees, .persons = {}}, .routes = {route}};
}

}  // namespace sim
