// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/map_corrector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "qwsm/mapping/mapper.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::test {
namespace {

/// The answers of a mapper on a drive, and where the robot was, in the frame of the map.
struct Answers {
  std::vector<MappingStep> steps;
  std::vector<Pose2> T_map_true;
};

Answers Drive(const Scene& scene) {
  const SimulatedDrive drive = DriveThrough(scene, {.laser = {.beams = 181, .range_max_m = 15.0}});
  Answers answers;
  Mapper mapper;
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    answers.steps.push_back(mapper.Process(drive.observations[i]));
    answers.T_map_true.push_back(drive.T_world_robot.front().Inverse() * drive.T_world_robot[i]);
  }
  return answers;
}

/// As if the map had drifted: each pose turns a little more than it should, and says so.
void Bend(std::vector<MappingStep>& steps, double turn_rad) {
  Pose2 T_bent;
  UncertainPose2 last;
  double sigma_rad = 0.0;
  for (MappingStep& step : steps) {
    const Pose2 moved = last.T_a_b.Inverse() * step.map_robot.T_a_b;
    last = step.map_robot;
    T_bent = T_bent * moved * Pose2{.theta_rad = turn_rad};
    sigma_rad += turn_rad;
    step.map_robot = UncertainPose2::WithSigmas(T_bent, 10.0 * sigma_rad, sigma_rad);
  }
}

double WorstError_m(const std::vector<UncertainPose2>& path, const std::vector<Pose2>& truth) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    worst_m = std::max(worst_m, (path[i].T_a_b.translation_m() - truth[i].translation_m()).norm());
  }
  return worst_m;
}

Correction Corrected(const std::vector<MappingStep>& steps) {
  MapCorrector corrector;
  for (const MappingStep& step : steps) corrector.Take(step);
  return corrector.Correct();
}

std::vector<UncertainPose2> PathOf(const std::vector<MappingStep>& steps) {
  std::vector<UncertainPose2> path;
  for (const MappingStep& step : steps) path.push_back(step.map_robot);
  return path;
}

TEST(MapCorrector, MendsThePathOnceTheRobotIsBack) {
  Answers answers = Drive(OfficeLoop());
  Bend(answers.steps, 0.0003);
  const double before_m = WorstError_m(PathOf(answers.steps), answers.T_map_true);
  ASSERT_GT(before_m, 0.5);
  const Correction correction = Corrected(answers.steps);
  ASSERT_EQ(correction.map_robot.size(), answers.steps.size());
  EXPECT_GT(std::ranges::count(correction.loops, LoopVerdict::kAccepted, &Loop::verdict), 3);
  EXPECT_LT(WorstError_m(correction.map_robot, answers.T_map_true), 0.2 * before_m);
}

TEST(MapCorrector, GivesTheSameTwice) {
  const Answers answers = Drive(OfficeLoop());
  const Correction once = Corrected(answers.steps);
  const Correction twice = Corrected(answers.steps);
  ASSERT_EQ(once.map_robot.size(), twice.map_robot.size());
  for (std::size_t i = 0; i < once.map_robot.size(); ++i) {
    EXPECT_EQ(once.map_robot[i].T_a_b, twice.map_robot[i].T_a_b) << i;
  }
}

TEST(MapCorrector, LeavesAPathWithoutLoopsAsItWasAnswered) {
  Scene scene = OfficeLoop();
  scene.route_m.resize(2);
  const Answers answers = Drive(scene);
  const Correction correction = Corrected(answers.steps);
  EXPECT_TRUE(correction.loops.empty());
  ASSERT_EQ(correction.map_robot.size(), answers.steps.size());
  for (std::size_t i = 0; i < answers.steps.size(); ++i) {
    EXPECT_EQ(correction.map_robot[i].T_a_b, answers.steps[i].map_robot.T_a_b) << i;
    EXPECT_EQ(correction.map_robot[i].covariance, answers.steps[i].map_robot.covariance) << i;
  }
}

// The answers go on a third of a metre beside, the scans do not.
TEST(MapCorrector, MendsAStepThatWasAnsweredWrongly) {
  Answers answers = Drive(OfficeLoop());
  const std::size_t half_way = answers.steps.size() / 2;
  const Pose2 T_wrong = {.x_m = 0.3, .y_m = -0.2};
  for (std::size_t i = half_way; i < answers.steps.size(); ++i) {
    answers.steps[i].map_robot.T_a_b = T_wrong * answers.steps[i].map_robot.T_a_b;
    answers.steps[i].map_robot.covariance.diagonal() += Eigen::Vector3d(0.1, 0.1, 0.001);
  }
  const Correction correction = Corrected(answers.steps);
  EXPECT_LT(WorstError_m({correction.map_robot.back()}, {answers.T_map_true.back()}), 0.1);
}

TEST(MapCorrector, TakesScansThatShowNothing) {
  MapCorrector corrector;
  EXPECT_TRUE(corrector.Correct().map_robot.empty());
  corrector.Take({.stamp = {}, .map_robot = {.T_a_b = {.x_m = 1.0}}});
  const Correction correction = corrector.Correct();
  ASSERT_EQ(correction.map_robot.size(), 1U);
  EXPECT_EQ(correction.map_robot.front().T_a_b.x_m, 1.0);
  EXPECT_TRUE(correction.map_node.empty());
}

TEST(MapCorrector, InsertsScansAnewWhereTheyBelong) {
  const Answers answers = Drive(FurnishedRoom());
  ScanMap map;
  std::vector<UncertainPose2> moved;
  for (const MappingStep& step : answers.steps) {
    if (!step.relevant) continue;
    map.Insert(step.relevant_scan, ToPoints(step.relevant_scan), step.map_robot);
    moved.push_back({.T_a_b = Pose2{.x_m = 5.0} * step.map_robot.T_a_b,
                     .covariance = step.map_robot.covariance});
  }
  const ScanMap elsewhere = Reinserted(map, moved);
  ASSERT_EQ(elsewhere.scans().size(), map.scans().size());
  EXPECT_NEAR(elsewhere.scans().back().map_robot.T_a_b.x_m,
              map.scans().back().map_robot.T_a_b.x_m + 5.0,
              1e-9);
}

}  // namespace
}  // namespace qwsm::test
