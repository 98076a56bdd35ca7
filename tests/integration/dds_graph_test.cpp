// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How the service appears to the tools of ROS 2.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <set>
#include <string>

#include "service/dds/entities/publications.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

/// What the graph says of the first node of a program.
struct Node {
  std::string name;
  std::string space;
  std::set<dds::Guid> writers;
};

Node NodeOf(const dds::wire::ParticipantEntitiesInfo& info) {
  if (info.node_entities_info_seq._length == 0) return {};
  const auto& told = info.node_entities_info_seq._buffer[0];
  Node node{.name = told.node_name, .space = told.node_namespace, .writers = {}};
  for (std::uint32_t i = 0; i < told.writer_gid_seq._length; ++i) {
    node.writers.insert(std::to_array(told.writer_gid_seq._buffer[i].data));
  }
  return node;
}

// ROS 2 lists a node's topics by the GIDs that it tells of its readers and writers.
TEST(DdsGraph, NodeTellsOfAllItsWriters) {
  const PrivateNetwork network;
  Daemon service(network.Join({"serve", "--set", "network.node=matcher"}));
  RobotInRoom robot(network);
  const dds::Reader<dds::wire::ParticipantEntitiesInfo> graph(
      robot.participant(), dds::kGraphTopic, dds::Profile::kLatchedIn);
  const dds::Publications publications(robot.participant());
  ASSERT_FALSE(robot.DriveUntilAnswered(1).empty());

  Node node;
  std::set<dds::Guid> writers;
  std::set<std::string> topics;
  const auto is_whole = [&] {
    graph.TakeAll([&](const auto& info) { node = NodeOf(info); });
    publications.TakeAll([&](const dds::Publication& publication) {
      if (!publication.is_alive || publication.participant == robot.participant().guid()) return;
      writers.insert(publication.writer);
      topics.insert(std::string(publication.topic));
    });
    return !writers.empty() && node.writers == writers;
  };
  for (int i = 0; i < 200 && !is_whole(); ++i) robot.Hear(50ms);
  EXPECT_EQ(node.writers, writers);
  EXPECT_EQ(node.name, "matcher");
  EXPECT_EQ(node.space, "/");
  for (const char* topic : {"rt/robot1/pose", "rt/tf", "rt/map", "rt/diagnostics"}) {
    EXPECT_TRUE(topics.contains(topic)) << topic;
  }
  EXPECT_EQ(service.End().exit_code, 0);
}

}  // namespace
}  // namespace qwsm::test
