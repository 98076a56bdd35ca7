// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// kill -9 while two maps become one gives two maps or one, never a mixture.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "service/team/service/team_service.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/team_in_room.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

constexpr int kKillsOfJoining = 20;
constexpr int kMostScans = 80;
constexpr std::uint64_t kJoined = 1'000'000;  // No scan has that number.

/// Tells when a joint is safe.
class JointTeller final : public TeamSink {
 public:
  explicit JointTeller(test::ChildProcess::Tell tell) : tell_(std::move(tell)) {}
  void TakeEpoch(const TeamEpoch&) override { tell_(kJoined); }

 private:
  test::ChildProcess::Tell tell_;
};

/// A robot maps the room; another one that nobody placed is found in it, a minute later.
void DriveUntilJoined(TeamService& service,
                      const std::function<bool()>& is_joined,
                      const std::function<void(int)>& done) {
  service.Start();
  const auto drive = [&](const std::string& robot, int scan, std::chrono::minutes later) {
    test::Give(service, robot, scan, 1, later);
    service.WaitUntilIdle();
  };
  for (int scan = 0; scan < 126; ++scan) drive("robot1", scan, 0min);
  for (int scan = 1; scan <= kMostScans && !is_joined(); ++scan) {
    drive("robot2", 29 + scan, 1min);
    done(scan);
  }
}

class JointCrash : public ::testing::Test {
 protected:
  void SetUp() override {
    test::RecordingSink sink;
    TeamService service(test::LosslessOptions(), sink);
    DriveUntilJoined(
        service, [&] { return !sink.epochs().empty(); }, [&](int scan) { joined_at_ = scan; });
    const std::vector<TeamEpoch> epochs = sink.epochs();
    ASSERT_EQ(epochs.size(), 1U);
    for (const MovedScan& scan : epochs.front().scans) {
      if (scan.key.robot == "robot2") moved_.push_back(scan);
    }
    ASSERT_GT(moved_.size(), 1U);
  }

  /// Is killed after so many scans of the second robot, or a little later.
  /// @return whether the joint was told to be safe.
  static bool RunUntilKilled(const std::filesystem::path& journal, int scans, std::size_t spins) {
    test::ChildProcess child([&](const test::ChildProcess::Tell& tell) {
      JointTeller sink(tell);
      TeamService service(test::LosslessOptions(), sink, journal);
      DriveUntilJoined(
          service, [] { return false; }, [&](int scan) { tell(static_cast<std::uint64_t>(scan)); });
    });
    bool was_told = false;
    while (const std::optional<std::uint64_t> told = child.Hear()) {
      was_told = was_told || *told == kJoined;
      if (*told == static_cast<std::uint64_t>(scans)) break;
    }
    for (std::size_t spin = spins; spin > 0; --spin) asm volatile("");
    child.Kill();
    while (const auto told = child.Hear()) was_told = was_told || *told == kJoined;
    return was_told;
  }

  int joined_at_ = 0;
  std::vector<MovedScan> moved_;  // Of the second robot.
};

TEST_F(JointCrash, MapsAreTwoOrOne) {
  std::mt19937 random(7);
  int joined = 0;
  int apart = 0;
  for (int kill = 0; kill < kKillsOfJoining; ++kill) {
    SCOPED_TRACE(kill);
    const test::TemporaryFolder folder;
    // Well before, just behind, or half of the time within the joint.
    const int scans = joined_at_ - (kill % 4 == 0 ? 4 : kill % 4 == 1 ? 0 : 1);
    const bool was_told = RunUntilKilled(folder.path() / "team.db", scans, random() % 50'000'000);
    test::RecordingSink sink;
    TeamService service(test::LosslessOptions(), sink, folder.path() / "team.db");
    const bool is_joined = service.MapOf("robot2") == service.MapOf("robot1");
    EXPECT_TRUE(is_joined || !was_told);
    std::size_t restored = 0;
    for (const TeamScan& scan : service.MapOf("robot2")->Scans()) {
      if (scan.key.robot != "robot2" || restored == moved_.size()) continue;
      const MovedScan& moved = moved_[restored++];
      EXPECT_EQ(scan.map_robot.T_a_b, is_joined ? moved.map_robot.T_a_b : moved.T_map_robot_before);
    }
    EXPECT_TRUE(!is_joined || restored == moved_.size());
    ++(is_joined ? joined : apart);
  }
  EXPECT_GT(joined, 0);
  EXPECT_GT(apart, 0);
}

}  // namespace
}  // namespace qwsm::team
