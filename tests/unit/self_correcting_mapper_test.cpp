// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/self_correcting_mapper.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <vector>

#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::test {
namespace {

std::vector<Observation> OfficeDrive() {
  return DriveThrough(OfficeLoop(), {.laser = {.beams = 181, .range_max_m = 15.0}}).observations;
}

std::function<void()> OnAnotherThread(std::function<void()> work) {
  auto done = std::make_shared<std::future<void>>(std::async(std::launch::async, std::move(work)));
  return [done] { done->get(); };
}

TEST(SelfCorrectingMapper, AnswersAsTheIncrementalOneWhileTheMapIsRight) {
  SelfCorrectingMapper correcting;
  Mapper incremental;
  for (const Observation& observation : OfficeDrive()) {
    const MappingStep step = correcting.Process(observation);
    EXPECT_EQ(step.map_robot.T_a_b, incremental.Process(observation).map_robot.T_a_b);
    EXPECT_EQ(step.epoch, 0);
  }
  EXPECT_TRUE(correcting.epochs().empty());
  EXPECT_EQ(correcting.Correct().map_node.size(), incremental.map().scans().size());
}

TEST(SelfCorrectingMapper, GivesThePathOfAllScans) {
  const std::vector<Observation> drive = OfficeDrive();
  SelfCorrectingMapper mapper;
  for (const Observation& observation : drive) mapper.Process(observation);
  const Correction correction = mapper.Correct();
  EXPECT_EQ(correction.map_robot.size(), drive.size());
  mapper.ForgetPoints();
  EXPECT_TRUE(mapper.mapper().map().surfaces().empty());
  EXPECT_EQ(mapper.mapper().map().scans().size(), correction.map_node.size());
  EXPECT_EQ(mapper.MapAt(correction.map_node).scans().size(), correction.map_node.size());
}

TEST(SelfCorrectingMapper, DoesNotDependOnThreads) {
  SelfCorrectingMapper at_once;
  SelfCorrectingMapper beside({}, OnAnotherThread);
  for (const Observation& observation : OfficeDrive()) {
    EXPECT_EQ(at_once.Process(observation).map_robot.T_a_b,
              beside.Process(observation).map_robot.T_a_b);
  }
  const Correction one = at_once.Correct();
  const Correction other = beside.Correct();
  ASSERT_EQ(one.map_robot.size(), other.map_robot.size());
  for (std::size_t i = 0; i < one.map_robot.size(); ++i) {
    EXPECT_EQ(one.map_robot[i].T_a_b, other.map_robot[i].T_a_b) << i;
  }
}

}  // namespace
}  // namespace qwsm::test
