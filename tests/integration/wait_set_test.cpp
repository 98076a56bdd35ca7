// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Waiting for several readers at once.
#include "service/dds/entities/wait_set.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/writer.hpp"
#include "tests/support/network.hpp"

namespace qwsm::dds {
namespace {

using namespace std::chrono_literals;

TEST(WaitSet, TellsWhichReadersHaveSamples) {
  const test::PrivateNetwork network;
  const Participant participant({.interface = "lo", .tag = network.tag()});
  const Reader<wire::Odometry> quiet(participant, "/quiet", Profile::kSensorIn);
  const Reader<wire::Odometry> heard(participant, "/heard", Profile::kSensorIn);
  const Writer<wire::Odometry> writer(participant, "/heard", Profile::kSensorOut);
  WaitSet waiting(participant);
  waiting.Add(quiet.handle());
  waiting.Add(heard.handle());
  EXPECT_TRUE(waiting.Wait(0s).empty());

  writer.Write({});
  EXPECT_EQ(waiting.Wait(10s), std::vector{heard.handle()});
  EXPECT_EQ(waiting.Wait(10s), std::vector{heard.handle()}) << "until it is taken";
  EXPECT_EQ(heard.TakeAll([](const wire::Odometry&) {}), 1U);
  EXPECT_TRUE(waiting.Wait(0s).empty());

  waiting.Wake();
  EXPECT_TRUE(waiting.Wait(10s).empty()) << "who calls is no reader";
  waiting.Remove(heard.handle());
  writer.Write({});
  EXPECT_TRUE(waiting.Wait(0s).empty());
}

}  // namespace
}  // namespace qwsm::dds
