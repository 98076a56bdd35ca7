// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/consistency.hpp"

#include <cmath>
#include <utility>

#include "tests/support/scenes.hpp"

namespace qwsm::test {
namespace {

// The scans that the map of a localization is made of are seeded apart from those of the drive.
constexpr std::uint64_t kMapSeedOffset = 1000;

// A map of the scene without an error in its poses.
ScanMap TrueMap(const ConsistencyScenario& scenario,
                const MapperOptions& options,
                std::uint64_t seed) {
  DriveOptions drive_options = scenario.drive;
  drive_options.seed = seed + kMapSeedOffset;
  const SimulatedDrive drive = DriveThrough(scenario.scene, drive_options);
  ScanMap map(options.map);
  std::optional<Pose2> T_world_last;
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    const Pose2& T_world_robot = drive.T_world_robot[i];
    const Pose2 moved = T_world_last.value_or(Pose2{}).Inverse() * T_world_robot;
    const bool is_relevant = !T_world_last ||
                             moved.translation_m().norm() > options.relevant_translation_m ||
                             std::abs(moved.theta_rad) > options.relevant_rotation_rad;
    if (!is_relevant) continue;
    const LaserScan& scan = drive.observations[i].scan;
    map.Insert(scan, ToPoints(scan), {.T_a_b = T_world_robot});
    T_world_last = T_world_robot;
  }
  return map;
}

// Sums up answers against the truth.
class ConsistencyTally {
 public:
  // `axis_rad` in the frame of the answers.
  void Add(const MappingStep& step, const Pose2& T_map_robot, double axis_rad) {
    if (step.status == StepStatus::kDeadReckoned) ++result_.dead_reckoned;
    const std::optional<double> nees = Nees(step.map_robot, T_map_robot);
    if (!nees) {
      ++result_.without_covariance;
      return;
    }
    nees_.push_back(*nees);
    const Pose2& estimate = step.map_robot.T_a_b;
    const Eigen::Vector2d error_m = estimate.translation_m() - T_map_robot.translation_m();
    const Eigen::Matrix2d covariance_m2 = step.map_robot.covariance.topLeftCorner<2, 2>();
    const Eigen::Vector2d along(std::cos(axis_rad), std::sin(axis_rad));
    const Eigen::Vector2d across(-along.y(), along.x());
    AddSquares(result_.along_m, error_m.dot(along), along.dot(covariance_m2 * along));
    AddSquares(result_.across_m, error_m.dot(across), across.dot(covariance_m2 * across));
    AddSquares(result_.heading_rad,
               NormalizeAngle(estimate.theta_rad - T_map_robot.theta_rad),
               step.map_robot.covariance(2, 2));
  }

  ConsistencyResult Result() const {
    ConsistencyResult result = result_;
    result.nees = SummarizeNees(nees_);
    for (ErrorAndSigma* sums : {&result.along_m, &result.across_m, &result.heading_rad}) {
      sums->error = std::sqrt(sums->error / static_cast<double>(nees_.size()));
      sums->sigma = std::sqrt(sums->sigma / static_cast<double>(nees_.size()));
    }
    return result;
  }

 private:
  static void AddSquares(ErrorAndSigma& sums, double error, double variance) {
    sums.error += error * error;
    sums.sigma += variance;
  }

  ConsistencyResult result_;  // Sums of squares, until the end.
  std::vector<double> nees_;
};

void Localize(const ConsistencyScenario& scenario,
              const SimulatedDrive& drive,
              MapperOptions options,
              std::uint64_t seed,
              ConsistencyTally& tally) {
  options.extend_map = false;
  ScanMap map = TrueMap(scenario, options, seed);
  Mapper mapper(options, std::move(map), {.T_a_b = drive.T_world_robot.front()});
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    const MappingStep step = mapper.Process(drive.observations[i]);
    if (i > 0) tally.Add(step, drive.T_world_robot[i], scenario.axis_rad);
  }
}

void Map(const ConsistencyScenario& scenario,
         const SimulatedDrive& drive,
         const MapperOptions& options,
         ConsistencyTally& tally) {
  // The map begins where odometry does: at the first pose.
  const Pose2 T_map_world = drive.T_world_robot.front().Inverse();
  Mapper mapper(options);
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    const MappingStep step = mapper.Process(drive.observations[i]);
    if (i == 0) continue;
    const double axis_map_rad = scenario.axis_rad + T_map_world.theta_rad;
    tally.Add(step, T_map_world * drive.T_world_robot[i], axis_map_rad);
  }
}

}  // namespace

std::vector<ConsistencyScenario> ConsistencyScenarios() {
  const DriveOptions usual;
  DriveOptions short_sighted;
  short_sighted.laser.range_max_m = 8.0;
  DriveOptions in_the_park;
  in_the_park.laser.range_max_m = 11.0;
  in_the_park.laser.beams = 181;
  in_the_park.speed_mps = 1.0;
  return {{"room", FurnishedRoom(), usual, 0.25},
          {"two rooms", TwoRoomsAndCorridor(), usual, 0.3},
          {"offices", OfficeLoop(), usual, 0.2},
          {"corridor with ends", LongCorridor(), usual, -0.4},
          {"corridor without", LongCorridor(), short_sighted, -0.4},
          {"park", Park(), in_the_park, 0.1}};
}

ConsistencyResult EvaluateConsistency(const ConsistencyScenario& scenario,
                                      ConsistencyTask task,
                                      const MapperOptions& options,
                                      std::uint64_t seeds) {
  ConsistencyTally tally;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    DriveOptions drive_options = scenario.drive;
    drive_options.seed = seed;
    const SimulatedDrive drive = DriveThrough(scenario.scene, drive_options);
    if (task == ConsistencyTask::kLocalize) {
      Localize(scenario, drive, options, seed, tally);
    } else {
      Map(scenario, drive, options, tally);
    }
  }
  return tally.Result();
}

}  // namespace qwsm::test
