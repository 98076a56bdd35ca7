// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A flood of nonsense: what a service keeps of it is bounded, and robots are answered meanwhile.
#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <vector>

#include "tests/support/hostile_peer.hpp"
#include "tests/support/process_state.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

// Their own accounts make these grow; what is lost for good, LeakSanitizer tells at the end.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;
#else
constexpr bool kMemoryIsOurs = true;
#endif

/// A robot that stands in the room and measures on: nothing that it sees is new.
class StandingRobot {
 public:
  explicit StandingRobot(RobotInRoom& robot)
      : robot_(robot), observation_(robot.NextObservation()) {}

  /// @returns how many answers came meanwhile. None is dead-reckoned.
  std::size_t Measure() {
    observation_.scan.stamp += 100ms;
    robot_.Publish(observation_);
    const std::vector<dds::MatchReport> reports = robot_.Hear(10ms);
    for (const dds::MatchReport& report : reports) {
      EXPECT_NE(report.status, StepStatus::kDeadReckoned) << report.reason;
    }
    return reports.size();
  }

 private:
  RobotInRoom& robot_;
  Observation observation_;
};

TEST(DdsGarbage, TakesNoMemoryAndFewAnswers) {
  const PrivateNetwork network;
  Daemon service(network.JoinService({"serve", "robot1"}));
  RobotInRoom in_room(network);
  StandingRobot robot(in_room);
  HostilePeer hostile(in_room.participant(), "robot1");
  for (int i = 0; i < 1000 && (robot.Measure() == 0 || !hostile.is_heard()); ++i) continue;
  ASSERT_TRUE(hostile.is_heard());

  const std::vector<std::uint16_t> ports = UdpPorts(service.process());
  ASSERT_FALSE(ports.empty());
  const auto flood = [&](std::size_t rounds) {
    std::size_t answers = 0;
    for (std::size_t i = 0; i < rounds; ++i) {
      SendGarbage(ports, 300);
      hostile.PublishAbsurdities();
      answers += robot.Measure();
    }
    return answers;
  };
  constexpr std::size_t kRounds = 500;
  flood(kRounds / 2);  // Buffers fill, and what is kept of frames that might be there.
  const double before_kb = ResidentKilobytes(service.process());
  const std::size_t answers = flood(kRounds);
  const double growth_kb = ResidentKilobytes(service.process()) - before_kb;
  std::cout << "memory " << before_kb << " kB, grown by " << growth_kb << " kB; " << answers
            << " of " << kRounds << " scans answered meanwhile\n";
  // Scans alone are 10 kB each, transforms 100 kB, and there are 300 datagrams in a round. What
  // grows is the allocator's: after 2000 rounds nothing does.
  if (kMemoryIsOurs) {
    EXPECT_LT(growth_kb, 4.0 * kRounds);
  }
  EXPECT_GT(answers, kRounds / 2);

  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;
}

}  // namespace
}  // namespace qwsm::test
