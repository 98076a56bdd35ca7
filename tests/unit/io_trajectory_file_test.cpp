// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <string>

#include "service/io/trajectories/graph_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

TEST(TumTrajectory, IsWrittenWithNineDecimalsOfTime) {
  std::ostringstream stream;
  WriteTumLine(stream, {.stamp = 976052857337531001ns, .T_map_robot = {1.5, -0.1, 0.0}});
  EXPECT_EQ(stream.str(), "976052857.337531001 1.5 -0.1 0 0 0 0 1\n");
}

TEST(TumTrajectory, ReadsBackWhatItWrote) {
  const StampedPose2 pose{.stamp = 1000000000000000007ns,
                          .T_map_robot = {1.0 / 3.0, -2e-17, -3.0001}};
  std::stringstream stream;
  WriteTumLine(stream, pose);
  const Trajectory trajectory = ReadTum(stream, "test.tum");
  ASSERT_EQ(trajectory.size(), 1U);
  EXPECT_EQ(trajectory[0].stamp, pose.stamp);
  EXPECT_EQ(trajectory[0].T_map_robot.x_m, pose.T_map_robot.x_m);
  EXPECT_EQ(trajectory[0].T_map_robot.y_m, pose.T_map_robot.y_m);
  EXPECT_NEAR(trajectory[0].T_map_robot.theta_rad, pose.T_map_robot.theta_rad, 1e-15);
}

TEST(KittiTrajectory, HasTheUpperRowsOfEachMatrix) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "trajectory.kitti";
  WriteKittiFile(
      file, {{.stamp = 1s, .T_map_robot = {1.5, -2.0, 0.0}}, {.stamp = 2s, .T_map_robot = {}}});
  EXPECT_EQ(test::ReadFile(file), "1 0 0 1.5 0 1 0 -2 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
}

PoseGraph GraphOfOneEdge(const Pose2& T_from_to) {
  PoseGraph graph{.T_map_node = {{}, {1.0, 2.0, 0.5}},
                  .edges = {{.from = 0, .to = 1, .T_from_to = T_from_to}}};
  graph.edges[0].information << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  return graph;
}

TEST(PoseGraphFile, ListsTheInformationAsEachFormatDoes) {
  const test::TemporaryFolder folder;
  const PoseGraph graph = GraphOfOneEdge({1.0, 2.0, 0.0});
  WriteG2oFile(folder.path() / "graph.g2o", graph);
  WriteToroFile(folder.path() / "graph.toro", graph);
  EXPECT_EQ(test::ReadFile(folder.path() / "graph.g2o"),
            "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 2 0.5\nFIX 0\n"
            "EDGE_SE2 0 1 1 2 0 11 12 13 22 23 33\n");
  EXPECT_EQ(test::ReadFile(folder.path() / "graph.toro"),
            "VERTEX2 0 0 0 0\nVERTEX2 1 1 2 0.5\nEDGE2 0 1 1 2 0 11 12 22 33 13 23\n");
}

/// The squared error of the first edge of a file, as g2o computes it: that of
/// T_from_to^-1 * T_map_from^-1 * T_map_to.
double ErrorInG2o(const std::filesystem::path& file, const PoseGraph& graph) {
  std::istringstream stream(test::ReadFile(file));
  std::string line;
  while (!line.starts_with("EDGE_SE2")) std::getline(stream, line);
  std::istringstream edge(line.substr(std::string("EDGE_SE2 0 1").size()));
  Pose2 T_from_to;
  edge >> T_from_to.x_m >> T_from_to.y_m >> T_from_to.theta_rad;
  Eigen::Matrix3d information;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      edge >> information(row, column);
      information(column, row) = information(row, column);
    }
  }
  const Pose2 delta = T_from_to.Inverse() * (graph.T_map_node[0].Inverse() * graph.T_map_node[1]);
  const Eigen::Vector3d error(delta.x_m, delta.y_m, delta.theta_rad);
  return error.dot(information * error);
}

TEST(PoseGraphFile, WeighsTheErrorsOfAnEdgeInG2oAsTheGraphDoes) {
  const test::TemporaryFolder folder;
  const PoseGraph graph = GraphOfOneEdge({0.8, 2.3, 1.4});
  WriteG2oFile(folder.path() / "graph.g2o", graph);
  EXPECT_NEAR(
      ErrorInG2o(folder.path() / "graph.g2o", graph), Chi2(graph.edges[0], graph.T_map_node), 1e-9);
}

TEST(TumTrajectory, TakesTheYawOfAPoseInSpace) {
  // Yaw of 90 degrees, then a roll of 90 degrees.
  std::istringstream stream("1 0 0 5 0.5 0.5 0.5 0.5\n");
  EXPECT_NEAR(ReadTum(stream, "test.tum").at(0).T_map_robot.theta_rad, 1.5707963, 1e-6);
}

TEST(TumTrajectory, TakesQuaternionsOfAnyLengthButNone) {
  std::istringstream stream("1 0 0 0 0 0 1e200 1e200\n2 0 0 0 0 0 1e-300 1e-300\n");
  for (const StampedPose2& pose : ReadTum(stream, "test.tum")) {
    EXPECT_NEAR(pose.T_map_robot.theta_rad, 1.5707963, 1e-6);
  }
  std::istringstream zero("1 0 0 0 0 0 0 0\n");
  EXPECT_THROW(ReadTum(zero, "test.tum"), std::runtime_error);
}

TEST(TumTrajectory, NamesTheLineThatIsNoPose) {
  std::istringstream stream("# t x y z qx qy qz qw\n\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n");
  try {
    ReadTum(stream, "test.tum");
    FAIL() << "did not throw";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("test.tum:4: the line ends early"));
  }
}

TEST(TumTrajectory, NamesTheArchiveThatIsBroken) {
  std::istringstream stream("\x1f\x8b is how gzip begins, and this is not");
  try {
    ReadTum(stream, "test.tum.gz");
    FAIL() << "did not throw";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(
        std::string(error.what()).starts_with("test.tum.gz: the gzip archive is truncated"));
  }
}

}  // namespace
}  // namespace qwsm::io
