// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the mapper promises of every drive, whatever its figures.
#include "qwsm/mapping/mapper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "qwsm/sensor/laser_mountings.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::test {
namespace {

SimulatedDrive RoomDrive(std::size_t scans, std::uint64_t seed = 1) {
  DriveOptions options;
  options.seed = seed;
  SimulatedDrive drive = DriveThrough(FurnishedRoom(), options);
  drive.observations.resize(std::min(scans, drive.observations.size()));
  return drive;
}

std::vector<MappingStep> MapAll(const std::vector<Observation>& observations, Mapper& mapper) {
  std::vector<MappingStep> steps;
  for (const Observation& observation : observations) steps.push_back(mapper.Process(observation));
  return steps;
}

/// How far off the last pose is, seen from the first.
double ErrorAtTheEnd_m(const SimulatedDrive& drive, const std::vector<MappingStep>& steps) {
  const std::size_t last = steps.size() - 1;
  const Pose2 truth = drive.T_world_robot[0].Inverse() * drive.T_world_robot[last];
  const Pose2 estimate = steps[0].map_robot.T_a_b.Inverse() * steps[last].map_robot.T_a_b;
  return (truth.Inverse() * estimate).translation_m().norm();
}

TEST(Mapper, FollowsARobotAroundARoom) {
  const SimulatedDrive drive = RoomDrive(80);
  Mapper mapper;
  const auto steps = MapAll(drive.observations, mapper);
  EXPECT_EQ(steps.front().status, StepStatus::kFirst);
  EXPECT_TRUE(steps.front().relevant);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_NE(steps[i].status, StepStatus::kDeadReckoned) << i << ": " << steps[i].reason;
    EXPECT_FALSE(steps[i].reason.empty()) << i;
  }
  EXPECT_LT(ErrorAtTheEnd_m(drive, steps), 0.05);
}

TEST(Mapper, AnswersTheSameToTheSame) {
  const SimulatedDrive drive = RoomDrive(40);
  Mapper first;
  Mapper second;
  const auto a = MapAll(drive.observations, first);
  const auto b = MapAll(drive.observations, second);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].map_robot.T_a_b, b[i].map_robot.T_a_b);
    EXPECT_EQ(a[i].map_robot.covariance, b[i].map_robot.covariance);
    EXPECT_EQ(a[i].status, b[i].status);
  }
}

TEST(Mapper, WorksWithoutOdometry) {
  SimulatedDrive drive = RoomDrive(60);
  for (Observation& observation : drive.observations) observation.T_odom_robot.reset();
  Mapper mapper;
  const auto steps = MapAll(drive.observations, mapper);
  EXPECT_EQ(steps.front().map_robot.T_a_b, Pose2{});
  EXPECT_LT(ErrorAtTheEnd_m(drive, steps), 0.1);
}

TEST(Mapper, DoesNotMindTimeRunningBackwards) {
  const SimulatedDrive drive = RoomDrive(40);
  SimulatedDrive backwards = drive;
  for (Observation& observation : backwards.observations) {
    observation.scan.stamp = -observation.scan.stamp;
  }
  Mapper first;
  Mapper second;
  const auto a = MapAll(drive.observations, first);
  const auto b = MapAll(backwards.observations, second);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].map_robot.T_a_b, b[i].map_robot.T_a_b);
    EXPECT_EQ(b[i].stamp, -a[i].stamp);
  }
}

TEST(Mapper, DeadReckonsThroughScansThatShowNothingAndComesBack) {
  SimulatedDrive drive = RoomDrive(60);
  for (std::size_t i = 30; i < 34; ++i) {
    LaserScan& scan = drive.observations[i].scan;
    if (i == 30) scan.ranges_m.clear();
    for (float& range_m : scan.ranges_m) range_m = std::numeric_limits<float>::quiet_NaN();
  }
  Mapper mapper;
  const auto steps = MapAll(drive.observations, mapper);
  for (std::size_t i = 30; i < 34; ++i) {
    EXPECT_EQ(steps[i].status, StepStatus::kDeadReckoned) << i;
    EXPECT_TRUE(IsFinite(steps[i].map_robot.T_a_b)) << i;
    EXPECT_GE(steps[i].map_robot.covariance.trace(), steps[i - 1].map_robot.covariance.trace())
        << i;
  }
  EXPECT_NE(steps[40].status, StepStatus::kDeadReckoned);
  EXPECT_LT(ErrorAtTheEnd_m(drive, steps), 0.05);
}

TEST(Mapper, OfNothingButEmptyScansMakesNoMap) {
  Mapper mapper;
  for (int i = 0; i < 5; ++i) {
    const MappingStep step = mapper.Process({.scan = {}, .T_odom_robot = Pose2{0.1 * i, 0.0, 0.0}});
    EXPECT_FALSE(step.relevant);
    EXPECT_NEAR(step.map_robot.T_a_b.x_m, 0.1 * i, 1e-12);
  }
  EXPECT_TRUE(mapper.map().surfaces().empty());
}

TEST(Mapper, DrivesOnFromWhereItWasPlacedThoughItSeesNothing) {
  const SimulatedDrive drive = RoomDrive(11);
  const UncertainPose2 placed = UncertainPose2::WithSigmas({5.0, -3.0, 1.5}, 0.02, 0.01);
  Mapper mapper;
  mapper.PlaceAt(placed);
  double trace = 0.0;
  for (std::size_t i = 0; i < 11; ++i) {
    Observation observation = drive.observations[i];
    if (i < 10) observation.scan.ranges_m.clear();
    const MappingStep step = mapper.Process(observation);
    const Pose2 driven = drive.observations[0].T_odom_robot->Inverse() * *observation.T_odom_robot;
    EXPECT_LT(Difference(placed.T_a_b * driven, step.map_robot.T_a_b).norm(), 1e-9) << i;
    EXPECT_GT(step.map_robot.covariance.trace(), trace) << i;
    trace = step.map_robot.covariance.trace();
  }
  ASSERT_EQ(mapper.map().scans().size(), 1U);
}

TEST(Mapper, LocalizesWithoutExtendingTheMap) {
  const SimulatedDrive drive = RoomDrive(60);
  Mapper mapper;
  MapAll(drive.observations, mapper);
  const std::size_t points = mapper.map().surfaces().quadtree().size();
  MapperOptions options;
  options.extend_map = false;
  Mapper localizer(options, mapper.map(), {.T_a_b = drive.observations[0].T_odom_robot.value()});
  const SimulatedDrive again = RoomDrive(60, 2);
  const auto steps = MapAll(again.observations, localizer);
  EXPECT_EQ(localizer.map().surfaces().quadtree().size(), points);
  EXPECT_LT(ErrorAtTheEnd_m(again, steps), 0.05);
}

TEST(LocalSubmap, KeepsTheLastOnesOnePointPerCell) {
  LocalSubmap submap({.count = 2, .points = 0, .spacing_m = 0.4});
  const auto point = [](double x_m, double y_m) {
    return std::vector<ScanPoint>{{.p_robot_m = {x_m, y_m}, .beam_robot = {1.0, 0.0}}};
  };
  submap.Add({}, point(1.0, 0.0));
  submap.Add({1.0, 0.0, 0.0}, point(1.0, 0.0));
  submap.Add({1.0, 0.0, 0.0}, point(1.05, 0.0));  // In the same cell; the first scan is forgotten.
  const auto points = submap.PointsAround({1.0, 0.0, 0.0});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].p_robot_m.x(), 1.05, 1e-12) << "the latest stays";
  submap.Clear();
  EXPECT_TRUE(submap.PointsAround({}).empty());
}

TEST(LocalSubmap, KeepsMoreScansWhereLittleIsInView) {
  LocalSubmap submap({.count = 2, .points = 5, .spacing_m = 0.4});
  for (int scan = 0; scan < 20; ++scan) {
    submap.Add({1.0 * scan, 0.0, 0.0},
               std::vector<ScanPoint>{{.p_robot_m = {2.0, 0.0}, .beam_robot = {1.0, 0.0}}});
  }
  EXPECT_EQ(submap.PointsAround({}).size(), 5U);
}

TEST(LocalSubmap, ForgetsScansOfALaserThatIsMountedAnewForEach) {
  LocalSubmap submap({.count = 2, .points = 5, .spacing_m = 0.4});
  for (int scan = 0; scan < 100; ++scan) {
    submap.Add({1.0 * scan, 0.0, 0.0},
               std::vector<ScanPoint>{{.p_robot_m = {2.0, 0.0}, .beam_robot = {1.0, 0.0}}},
               {1e-6 * scan, 0.0, 0.0});
  }
  EXPECT_EQ(submap.PointsAround({}).size(), 2 * kMostMountings);
}

}  // namespace
}  // namespace qwsm::test
