// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the bag of a run's answers says of frames.
#include "service/pipeline/results/answer_bag.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/io/bags/containers/bag_files.hpp"
#include "service/io/bags/messages/ros_messages.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::pipeline {
namespace {

/// The frames that `/tf` has in `map`, one after the other, in the bag of a run with such odometry.
std::vector<std::string> FramesInMap(const std::vector<std::optional<Pose2>>& odometry) {
  AnswerBag answers;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    TimedStep timed{.step = {}, .T_odom_robot = odometry[i]};
    timed.step.stamp = std::chrono::seconds(i);
    answers.Take(timed);
  }
  const test::TemporaryFolder folder;
  answers.Write(folder.path() / "answers.mcap", std::nullopt);

  io::OpenBagFile bag(folder.path() / "answers.mcap",
                      [](std::uint64_t, const std::string& what) { ADD_FAILURE() << what; });
  std::vector<std::string> frames;
  while (const auto message = bag.messages().Next()) {
    const io::BagTopic& topic = bag.messages().topics()[message->topic];
    if (topic.name != "/tf") continue;
    for (const auto& transform : io::DecodeTransforms(message->bytes, topic.encoding)) {
      EXPECT_EQ(transform.header.frame, "map");
      frames.push_back(transform.child_frame);
    }
  }
  return frames;
}

using Frames = std::vector<std::string>;

TEST(AnswerBag, GivesAFrameOneParentWhereOdometryHasAGap) {
  EXPECT_EQ(FramesInMap({Pose2{}, std::nullopt, Pose2{}}), (Frames{"odom", "odom"}));
  EXPECT_EQ(FramesInMap({std::nullopt, Pose2{}}), (Frames{"odom"}));
}

TEST(AnswerBag, TellsWhereARobotWithoutOdometryIs) {
  EXPECT_EQ(FramesInMap({std::nullopt, std::nullopt}), (Frames{"base_link", "base_link"}));
}

}  // namespace
}  // namespace qwsm::pipeline
