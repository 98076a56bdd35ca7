// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/park.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sim {
namespace {

constexpr double kWaypointSpacing_m = 8.0;
constexpr double kNearestGroup_m = 4.0;  // From the way to the middle of a group of trees.
constexpr double kFarthestGroup_m = 8.0;
constexpr double kLonelyCorner_m = 22.0;  // No group stands nearer to the sharp turn.
constexpr double kBetweenTrunks_m = 1.2;
constexpr double kNearestTree_m = 10.0;  // A single tree is planted at least so far ahead.
constexpr int kFewTrees = 2;
constexpr int kLayouts = 100;  // Tried at most.
constexpr int kAttempts = 1000;

/// Bottom right, bottom left, top left, top right, and a little over the start: when the robot
/// looks along its first metres again the loop is closed.
Route Loop(const ParkOptions& options, const Eigen::Vector2d& sharp_turn_m) {
  const double right = options.width_m - 5.0;
  const double top = options.height_m - 5.0;
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
constexpr View kSureView{18.5, qwsm::DegreesToRadians(75.0)};

int CountInView(const std::vector<RoundOptions>& trees,
                const qwsm::Pose2& T_world_robot,
                const View& view) {
  const qwsm::Pose2 T_robot_world = T_world_robot.Inverse();
  return static_cast<int>(std::ranges::count_if(trees, [&](const RoundOptions& tree) {
    const Eigen::Vector2d p_robot_m = T_robot_world * Eigen::Vector2d(tree.x_m, tree.y_m);
    const double bearing_rad = std::atan2(p_robot_m.y(), p_robot_m.x());
    return p_robot_m.norm() < view.range_m && std::abs(bearing_rad) < view.half_angle_rad;
  }));
}

/// Plants trees one by one where they are clear of the way and of each other.
class Planter {
 public:
  Planter(const ParkOptions& options, const Route& route, RandomEngine& random)
      : options_(options), route_(route), random_(random) {}

  void PlantGroup(const Eigen::Vector2d& middle_m) {
    PlantNear(middle_m, options_.group_radius_m, options_.trees_per_group);
    in_groups_ = trees_.size();
  }

  /// Plants single trees ahead until enough can be seen from a pose.
  void PlantInViewOf(const qwsm::Pose2& T_world_robot) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (CountInView(trees_, T_world_robot, kSureView) >= options_.min_in_view) return;
      const double bearing_rad =
          Uniform(random_, -kSureView.half_angle_rad, kSureView.half_angle_rad);
      const double range_m = Uniform(random_, kNearestTree_m, kSureView.range_m);
      const Eigen::Vector2d p_robot_m =
          range_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
      PlantNear(T_world_robot * p_robot_m, kBetweenTrunks_m, 1);
    }
  }

  /// Fells single trees that are not needed for that: later ones often serve earlier poses too.
  void FellSpare(const std::vector<qwsm::Pose2>& poses) {
    for (std::size_t i = in_groups_; i < trees_.size();) {
      const RoundOptions tree = trees_[i];
      const auto place = trees_.begin() + static_cast<std::ptrdiff_t>(i);
      trees_.erase(place);
      const bool is_spare = std::ranges::all_of(poses, [this](const qwsm::Pose2& T_world_robot) {
        return CountInView(trees_, T_world_robot, kSureView) >= options_.min_in_view;
      });
      if (is_spare) continue;
      trees_.insert(trees_.begin() + static_cast<std::ptrdiff_t>(i), tree);
      ++i;
    }
  }

  const std::vector<RoundOptions>& trees() const { return trees_; }
  const Route& route() const { return route_; }

 private:
  /// Plants so many trees within `radius_m` of the middle, or fewer where there is no more room.
  void PlantNear(const Eigen::Vector2d& middle_m, double radius_m, int trees) {
    for (int attempt = 0; attempt < kAttempts && trees > 0; ++attempt) {
      const double direction_rad = Uniform(random_, 0.0, 2.0 * std::numbers::pi);
      const double distance_m = radius_m * std::sqrt(Uniform(random_, 0.0, 1.0));
      const RoundOptions tree{
          .x_m = middle_m.x() + distance_m * std::cos(direction_rad),
          .y_m = middle_m.y() + distance_m * std::sin(direction_rad),
          .radius_m = Uniform(random_, options_.min_trunk_radius_m, options_.max_trunk_radius_m)};
      if (!IsFree(tree)) continue;
      trees_.push_back(tree);
      --trees;
    }
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

  const ParkOptions& options_;
  const Route& route_;
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
                 const Eigen::Vector2d& sharp_turn_m,
                 RandomEngine& random) {
  const Route& route = planter.route();
  const double legs_per_group = static_cast<double>(route.size() - 1) / options.groups;
  for (int group = 0; group < options.groups; ++group) {
    const double leg = (group + Uniform(random, 0.25, 0.75)) * legs_per_group;
    const Eigen::Vector2d middle_m = Beside(route, static_cast<std::size_t>(leg), random);
    if ((middle_m - sharp_turn_m).norm() < kLonelyCorner_m) continue;
    planter.PlantGroup(middle_m);
  }
}

/// Poses on the way: along each leg, and at each way point half-way round its turn.
std::vector<qwsm::Pose2> PosesAlong(const Route& route) {
  std::vector<qwsm::Pose2> poses{StartOf(route)};
  for (std::size_t i = 1; i + 1 < route.size(); ++i) {
    const double before_rad = StartOf({route[i - 1], route[i]}).theta_rad;
    const double turn_rad =
        qwsm::NormalizeAngle(StartOf({route[i], route[i + 1]}).theta_rad - before_rad);
    for (const double share : {0.0, 0.5, 1.0}) {
      const double heading_rad = qwsm::NormalizeAngle(before_rad + share * turn_rad);
      poses.push_back({route[i].x_m, route[i].y_m, heading_rad});
    }
  }
  return poses;
}

}  // namespace

Place MakePark(const ParkOptions& options, RandomEngine& random) {
  const Eigen::Vector2d sharp_turn_m(options.width_m - 5.0, options.height_m - 4.0);
  const Route route = Refined(Loop(options, sharp_turn_m), kWaypointSpacing_m);
  const std::vector<qwsm::Pose2> poses = PosesAlong(route);
  std::vector<RoundOptions> trees;
  for (int attempt = 0; attempt < kLayouts; ++attempt) {
    Planter planter(options, route, random);
    PlantGroups(planter, options, sharp_turn_m, random);
    for (const qwsm::Pose2& T_world_robot : poses) planter.PlantInViewOf(T_world_robot);
    planter.FellSpare(poses);
    trees = planter.trees();
    const auto lonely = std::ranges::count_if(poses, [&](const qwsm::Pose2& T_world_robot) {
      return CountInView(trees, T_world_robot, kView) <= kFewTrees;
    });
    if (static_cast<double>(lonely) >= options.lonely_share * static_cast<double>(poses.size())) {
      break;
    }
  }
  return {.scenery = {.walls = {}, .boxes = {}, .rounds = trees, .persons = {}}, .routes = {route}};
}

}  // namespace sim
