// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <string>

#include "service/io/trajectories/relations_file.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

TEST(RelationsFile, ReadsTheTruePoseBetweenTwoMoments) {
  std::istringstream stream(
      "# t1 t2 x y z roll pitch yaw\n976052905.167284 976052911.886684 -0.5 -0.1 0 0 0 -1.5\n");
  const auto relations = ReadRelations(stream, "test.relations");
  ASSERT_EQ(relations.size(), 1U);
  EXPECT_EQ(relations[0].first, 976052905167284us);
  EXPECT_EQ(relations[0].second, 976052911886684us);
  EXPECT_EQ(relations[0].T_first_second, (Pose2{-0.5, -0.1, -1.5}));
}

TEST(RelationsFile, NamesTheLineThatIsNoRelation) {
  std::istringstream stream("1 2 0 0 0 0 0 0\n1 2 0 0 0 0 0\n");
  try {
    ReadRelations(stream, "test.relations");
    FAIL() << "did not throw";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("test.relations:2: the line ends early"));
  }
  EXPECT_THROW(ReadRelationsFile("no/such.relations"), std::runtime_error);
}

}  // namespace
}  // namespace qwsm::io
