// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where robots of a team were, in the map as it is at the end.
#include "service/pipeline/team/path_in_map.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace qwsm::pipeline {
namespace {

using namespace std::chrono_literals;

constexpr team::MapVersion kComponent{.map = 2, .epoch = 0};
constexpr team::MapVersion kJoined{.map = 1, .epoch = 1};
// Where the component's frame came to lie.
const Pose2 kT_map_component{10.0, 5.0, 0.5};

// One metre a second along x.
Pose2 Driven(Timestamp stamp) { return {std::chrono::duration<double>(stamp).count(), 0.0, 0.0}; }

// Four answers in a component, then four in the map that it has joined.
std::vector<io::PathPose> Answered() {
  std::vector<io::PathPose> answered;
  for (Timestamp stamp = 0s; stamp < 8s; stamp += 1s) {
    const Pose2 T_robot = Driven(stamp);
    answered.push_back({.stamp = stamp,
                        .map_robot = {.T_a_b = stamp < 4s ? T_robot : kT_map_component * T_robot}});
  }
  return answered;
}

std::vector<AnsweredStretch> Stretches(Trajectory relevant) {
  return {{.version = kComponent, .since = 0s, .relevant = std::move(relevant)},
          {.version = kJoined, .since = 4s, .relevant = {}}};
}

TEST(PathInMap, GoesOnFromAComponentIntoTheMapItJoined) {
  const ScansInMap now{.version = kJoined, .T_map_robot = {{1s, kT_map_component * Driven(1s)}}};
  const auto path = PathInMap(Answered(), Stretches({{1s, Driven(1s)}}), now);
  ASSERT_EQ(path.size(), 8U);
  for (const io::PathPose& pose : path) {
    const Pose2 expected = kT_map_component * Driven(pose.stamp);
    EXPECT_NEAR(pose.map_robot.T_a_b.x_m, expected.x_m, 1e-9);
    EXPECT_NEAR(pose.map_robot.T_a_b.y_m, expected.y_m, 1e-9);
    EXPECT_NEAR(pose.map_robot.T_a_b.theta_rad, expected.theta_rad, 1e-9);
  }
}

TEST(PathInMap, GoesBesideTheRelevantScanNearestInTime) {
  const Pose2 aside{0.0, 2.0, 0.0};
  const ScansInMap now{.version = kJoined,
                       .T_map_robot = {{0s, Driven(0s)}, {3s, aside * Driven(3s)}}};
  const auto path = PathInMap(Answered(), Stretches({{0s, Driven(0s)}, {3s, Driven(3s)}}), now);
  ASSERT_EQ(path.size(), 8U);
  EXPECT_EQ(path[1].map_robot.T_a_b, Driven(1s));
  EXPECT_NEAR(path[2].map_robot.T_a_b.y_m, 2.0, 1e-9);
}

TEST(PathInMap, LeavesOutWhatTheMapKnowsNothingOf) {
  const ScansInMap elsewhere{.version = kJoined, .T_map_robot = {{7s, Driven(7s)}}};
  const auto path = PathInMap(Answered(), Stretches({{1s, Driven(1s)}}), elsewhere);
  ASSERT_EQ(path.size(), 4U);
  EXPECT_EQ(path.front().stamp, Timestamp(4s));
}

TEST(PathInMap, IsThatOfTheAnswersWhereNothingWasCorrected) {
  const std::vector<io::PathPose> answered = Answered();
  const AnsweredStretch all{.version = kJoined, .since = 0s, .relevant = {{1s, Driven(1s)}}};
  const auto path = PathInMap(answered, std::vector{all}, {.version = kJoined, .T_map_robot = {}});
  ASSERT_EQ(path.size(), answered.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i].map_robot.T_a_b, answered[i].map_robot.T_a_b);
  }
  EXPECT_TRUE(PathInMap({}, {}, {}).empty());
}

}  // namespace
}  // namespace qwsm::pipeline
