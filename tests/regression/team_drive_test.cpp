// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What sharing a map does to accuracy: four simulated robots in one office, once with a map each
// and once with one for all, scan for scan in the same order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/metrics/error_statistics.hpp"
#include "service/config/options_io.hpp"
#include "service/team/service/team_service.hpp"
#include "sim/simulation.hpp"
#include "tests/support/recording_sink.hpp"

namespace qwsm::team {
namespace {

constexpr std::size_t kRobots = 4;
// A robot alone may have been a few millimetres luckier.
constexpr double kLuck_m = 0.003;

/// How well robots are told where they start; the first one defines the frame and knows.
struct ToldStart {
  double sigma_m = 0.0;
  double sigma_rad = 0.0;
};

std::vector<sim::Reading> Drive(int seed, int duration_s, const std::string& scenario = "team") {
  sim::Simulation simulation(config::LoadOptions<sim::ScenarioOptions>(
      {.file = QWSM_SOURCE_DIR "/configs/scenarios/" + scenario + ".yaml",
       .settings = {"seed=" + std::to_string(seed), "duration_s=" + std::to_string(duration_s)}}));
  std::vector<sim::Reading> readings;
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    readings.push_back(std::move(*reading));
  }
  return readings;
}

/// All of the first robot, then the first minute of the others.
std::vector<sim::Reading> WithTheOthersLater(const std::vector<sim::Reading>& readings) {
  std::vector<sim::Reading> ordered;
  std::ranges::copy_if(readings, std::back_inserter(ordered), [](const sim::Reading& reading) {
    return reading.robot == 0;
  });
  std::ranges::copy_if(readings, std::back_inserter(ordered), [](const sim::Reading& reading) {
    return reading.robot > 0 && reading.scan.stamp < std::chrono::minutes(1);
  });
  return ordered;
}

std::string NameOf(std::size_t robot) { return "robot" + std::to_string(robot + 1); }

// Zero would be a claim that nobody can keep, and next to this there is no error to speak of.
UncertainPose2 ExactStart(const sim::Reading& first) {
  constexpr double kExact = 1e-3;
  return UncertainPose2::WithSigmas(first.T_world_robot, kExact, kExact);
}

UncertainPose2 StartOf(const sim::Reading& first, const ToldStart& told, std::mt19937_64& random) {
  const bool is_told_poorly = first.robot > 0 && told.sigma_m > 0.0;
  if (!is_told_poorly) return ExactStart(first);
  std::normal_distribution<double> normal;
  const Pose2 error{told.sigma_m * normal(random),
                    told.sigma_m * normal(random),
                    told.sigma_rad * normal(random)};
  return UncertainPose2::WithSigmas(first.T_world_robot * error, told.sigma_m, told.sigma_rad);
}

TeamServiceOptions SharedBy(MapSharing sharing) {
  TeamServiceOptions options;
  options.team.map = sharing;
  options.team.threads = 1;
  options.team.map_period_s = 0.0;
  return options;
}

void Give(TeamService& service, const sim::Reading& reading) {
  const std::string robot = NameOf(reading.robot);
  service.robots().TakeOdometry(robot, reading.scan.stamp, reading.T_odom_robot);
  service.robots().TakeScan(robot, reading.scan);
  service.WaitUntilIdle();
}

/// The root mean square of the errors of each robot's positions, in the frame of the world.
std::array<double, kRobots> Errors_m(const std::vector<sim::Reading>& readings,
                                     MapSharing sharing,
                                     const ToldStart& told = {}) {
  test::RecordingSink sink;
  TeamService service(SharedBy(sharing), sink);
  service.Start();
  std::mt19937_64 random(7);
  std::array<std::vector<double>, kRobots> errors_m;
  std::array<bool, kRobots> is_placed{};
  for (const sim::Reading& reading : readings) {
    const std::string robot = NameOf(reading.robot);
    if (!std::exchange(is_placed[reading.robot], true)) {
      service.robots().PlaceAt(robot, StartOf(reading, told, random));
    }
    Give(service, reading);
    const Pose2 error = reading.T_world_robot.Inverse() * sink.last_step(robot).map_robot.T_a_b;
    errors_m[reading.robot].push_back(error.translation_m().norm());
  }
  std::array<double, kRobots> rmse_m{};
  for (std::size_t i = 0; i < kRobots; ++i) rmse_m[i] = Summarize(errors_m[i]).rmse;
  return rmse_m;
}

TEST(TeamDrive, OneMapForAllIsAsAccurateAsOneEach) {
  std::vector<double> all_shared_m;
  std::vector<double> all_each_m;
  for (const int seed : {1, 2, 3}) {
    const std::vector<sim::Reading> readings = Drive(seed, 90);
    const std::array<double, kRobots> each_m = Errors_m(readings, MapSharing::kEachRobot);
    const std::array<double, kRobots> shared_m = Errors_m(readings, MapSharing::kTeam);
    for (std::size_t i = 0; i < kRobots; ++i) {
      SCOPED_TRACE(NameOf(i) + ", seed " + std::to_string(seed));
      EXPECT_LT(shared_m[i], 2.0 * each_m[i] + kLuck_m);
    }
    all_shared_m.insert(all_shared_m.end(), shared_m.begin(), shared_m.end());
    all_each_m.insert(all_each_m.end(), each_m.begin(), each_m.end());
  }
  // Of twelve robots, for which of them is lucky alone changes with every seed.
  EXPECT_LT(Summarize(all_shared_m).median, Summarize(all_each_m).median);
}

// Another robot goes along, ten metres ahead: in the corridor it is what tells most of how far the
// robot has gone, and that is nothing. Two metres it was behind in the end.
TEST(TeamDrive, WhoGoesAlongInACorridorHoldsNoRobotBack) {
  std::optional<Mapper> mapper;
  double error_m = 0.0;
  for (const sim::Reading& reading : Drive(8, 12)) {
    if (reading.robot != 0) continue;
    if (!mapper) {
      mapper.emplace(MapperOptions{}, ScanMap{}, ExactStart(reading));
    }
    const MappingStep step = mapper->Process(sim::ObservationOf(reading));
    const Pose2 error = reading.T_world_robot.Inverse() * step.map_robot.T_a_b;
    error_m = error.translation_m().norm();
  }
  EXPECT_LT(error_m, 0.05);
}

/// Where a robot is in the end.
struct Whereabouts {
  bool is_with_first = false;  ///< In the map of the first robot, who was told where it is.
  double error_m = 0.0;
};

std::array<Whereabouts, kRobots> AfterDrive(const std::vector<sim::Reading>& readings) {
  test::RecordingSink sink;
  TeamServiceOptions options = SharedBy(MapSharing::kTeam);
  options.merges_beside = false;
  TeamService service(options, sink);
  service.Start();
  service.robots().PlaceAt(NameOf(0), ExactStart(readings.front()));
  std::array<Whereabouts, kRobots> robots;
  for (const sim::Reading& reading : readings) {
    const std::string robot = NameOf(reading.robot);
    Give(service, reading);
    const Pose2 error = reading.T_world_robot.Inverse() * sink.last_step(robot).map_robot.T_a_b;
    robots[reading.robot].error_m = error.translation_m().norm();
  }
  for (std::size_t i = 0; i < kRobots; ++i) {
    robots[i].is_with_first = service.MapOf(NameOf(i)) == service.MapOf(NameOf(0));
  }
  return robots;
}

TEST(TeamDrive, RobotsThatNobodyPlacedAreFoundInTheMap) {
  const std::array<Whereabouts, kRobots> robots = AfterDrive(Drive(2, 60));
  for (std::size_t i = 0; i < kRobots; ++i) {
    EXPECT_TRUE(robots[i].is_with_first) << NameOf(i);
    EXPECT_LT(robots[i].error_m, 0.1) << NameOf(i);
  }
}

// Two wings are alike down to the furniture: what tells them apart is that robots do not see each
// other who would be in one room. The third robot was put 24 m off.
TEST(TeamDrive, NobodyIsPutIntoAWingThatLooksAlike) {
  int found = 0;
  for (const int seed : {22, 35, 56}) {
    for (const Whereabouts& robot : AfterDrive(Drive(seed, 60, "team_wings"))) {
      if (!robot.is_with_first) continue;
      ++found;
      EXPECT_LT(robot.error_m, 0.2) << "seed " << seed;
    }
  }
  EXPECT_GE(found, 4);  // The first ones, and somebody who is in their wing.
}

TEST(TeamDriveLater, RobotsThatComeIntoAKnownPlaceAreAsAccurateAsItsMap) {
  const std::vector<sim::Reading> readings = WithTheOthersLater(Drive(1, 300));
  const ToldStart poorly{.sigma_m = 0.1, .sigma_rad = 0.05};
  const std::array<double, kRobots> each_m = Errors_m(readings, MapSharing::kEachRobot, poorly);
  const std::array<double, kRobots> shared_m = Errors_m(readings, MapSharing::kTeam, poorly);
  EXPECT_EQ(shared_m[0], each_m[0]);
  for (std::size_t i = 1; i < kRobots; ++i) {
    RecordProperty(NameOf(i),
                   std::to_string(shared_m[i]) + " m, alone " + std::to_string(each_m[i]));
    EXPECT_LT(shared_m[i], 0.2 * each_m[i]) << NameOf(i);
    EXPECT_LT(shared_m[i], 3.0 * shared_m[0]) << NameOf(i);
  }
}

}  // namespace
}  // namespace qwsm::team
