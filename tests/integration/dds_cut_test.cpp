// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A network that falls in two while robots drive, and is whole again: two services, each with two
// robots, have one map afterwards. By hand for longer and for many drives:
//
//   QWSM_CUT_SEEDS=20 QWSM_CUT_DRIVE_S=300 QWSM_CUT_RATE=1 integration_dds --gtest_filter=DdsCut.*
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <tuple>
#include <variant>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "service/io/logs/journal_reader.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/cut_network.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::string Setting(const char* name, const char* otherwise) {
  const char* const value = std::getenv(name);
  return value == nullptr ? otherwise : value;
}

/// Robot, stamp and pose of each relevant scan of a journal, in order.
using Scans = std::vector<std::tuple<std::string, Timestamp, double, double, double>>;

Scans ScansOf(const std::filesystem::path& file) {
  Scans scans;
  io::JournalReader journal(file);
  while (const std::optional<io::LogRecord> record = journal.Next()) {
    const auto& reading = std::get<io::ScanReading>(*record);
    const Pose2 pose = reading.T_odom_robot.value_or(Pose2{});
    scans.emplace_back(reading.laser, reading.scan.stamp, pose.x_m, pose.y_m, pose.theta_rad);
  }
  std::ranges::sort(scans);
  return scans;
}

/// How many relevant scans a service says that it took of its robots.
std::size_t RelevantOf(const std::string& summary) {
  std::size_t sum = 0;
  for (std::size_t end = 0; (end = summary.find(" relevant;", end)) != summary.npos; ++end) {
    const std::size_t begin = summary.rfind(' ', end - 1);
    sum += std::stoul(summary.substr(begin, end - begin));
  }
  return sum;
}

class DdsCut : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_.path() / name; }

  /// Logs of four robots in one office, and where they start.
  void Simulate(int seed) const {
    RunProgram({"sim",
                "team",
                "--quiet",
                "--force",
                "--output",
                Path("driven"),
                "--seed",
                std::to_string(seed),
                "--duration",
                Setting("QWSM_CUT_DRIVE_S", "60")});
    std::ofstream starts(Path("team.yaml"));
    starts.precision(17);
    starts << "team:\n  session: {odometry_wait_s: 10, queue_scans: 1000}\n  robots:\n";
    for (const std::string robot : {"robot_1", "robot_2", "robot_3", "robot_4"}) {
      const Pose2 start =
          io::ReadTumFile(Path("driven/" + robot + ".truth.tum")).front().T_map_robot;
      starts << "    - {name: " << robot << ", x_m: " << start.x_m << ", y_m: " << start.y_m
             << ", heading_deg: " << RadiansToDegrees(start.theta_rad) << "}\n";
    }
  }
  std::unique_ptr<Daemon> Serve(const CutNetwork& network,
                                CutNetwork::Side side,
                                const std::vector<std::string>& robots) const {
    const std::string name = side == CutNetwork::kLeft ? "left" : "right";
    std::vector<std::string> arguments{"serve"};
    arguments.insert(arguments.end(), robots.begin(), robots.end());
    arguments.insert(arguments.end(),
                     {"--config",
                      Path("team.yaml"),
                      "--set",
                      "team.service=" + name,
                      "--journal",
                      Path(name + ".db"),
                      "--output",
                      Path(name),
                      "--force",
                      "--verbose"});
    auto service = network.Start(side, arguments);
    EXPECT_TRUE(service->WaitUntilItSays("serving as")) << service->ErrorsSoFar();
    return service;
  }
  std::unique_ptr<Daemon> Replay(const CutNetwork& network,
                                 CutNetwork::Side side,
                                 const std::string& robot) const {
    return network.Start(side,
                         {"replay",
                          Path("driven/" + robot + ".log"),
                          "--robot",
                          robot,
                          "--rate",
                          Setting("QWSM_CUT_RATE", "5"),
                          "--quiet"});
  }
  /// How long it takes until both services keep the same, in seconds; at most a minute.
  double SecondsUntilOneMap() const {
    const auto begin = Clock::now();
    const auto passed_s = [begin] {
      return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    while (passed_s() < 60.0 && ScansOf(Path("left.db")) != ScansOf(Path("right.db"))) {
      std::this_thread::sleep_for(100ms);
    }
    return passed_s();
  }

  TemporaryFolder folder_;
};

TEST_F(DdsCut, ServicesThatWereApartHaveOneMap) {
  if (!CutNetwork::IsPossible()) GTEST_SKIP() << "needs network namespaces: root, and iproute2";
  const int seeds = std::stoi(Setting("QWSM_CUT_SEEDS", "1"));
  for (int seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::filesystem::remove(Path("left.db"));
    std::filesystem::remove(Path("right.db"));
    Simulate(seed);
    const CutNetwork network;
    const auto left = Serve(network, CutNetwork::kLeft, {"robot_1", "robot_2"});
    const auto right = Serve(network, CutNetwork::kRight, {"robot_3", "robot_4"});
    std::vector<std::unique_ptr<Daemon>> robots;
    for (const auto& [side, robot] : {std::pair(CutNetwork::kLeft, "robot_1"),
                                      std::pair(CutNetwork::kLeft, "robot_2"),
                                      std::pair(CutNetwork::kRight, "robot_3"),
                                      std::pair(CutNetwork::kRight, "robot_4")}) {
      robots.push_back(Replay(network, side, robot));
    }
    EXPECT_TRUE(left->WaitUntilItSays("robot_2: joined"));
    EXPECT_TRUE(right->WaitUntilItSays("robot_4: joined"));
    std::this_thread::sleep_for(1s);
    network.Cut();
    const Clock::time_point cut = Clock::now();
    for (const auto& robot : robots) EXPECT_EQ(robot->Wait().exit_code, 0);
    EXPECT_NE(ScansOf(Path("left.db")), ScansOf(Path("right.db")));
    network.Heal();
    const std::chrono::duration<double> apart = Clock::now() - cut;
    const double took_s = SecondsUntilOneMap();
    std::cout << "seed " << seed << ": one map after " << took_s << " s, " << apart.count()
              << " s apart\n";
    EXPECT_LT(took_s, apart.count());

    const std::size_t relevant = RelevantOf(left->End().output) + RelevantOf(right->End().output);
    EXPECT_GT(relevant, 100U);
    EXPECT_EQ(ScansOf(Path("left.db")).size(), relevant);
    EXPECT_EQ(ScansOf(Path("left.db")), ScansOf(Path("right.db")));
    const std::string map = ReadFile(Path("left/map.pgm"));
    EXPECT_FALSE(map.empty());
    EXPECT_TRUE(map == ReadFile(Path("right/map.pgm")));
  }
}

// It hung until it was killed: what was to wake the threads that receive could not be sent.
TEST_F(DdsCut, AServiceWithoutNetworkEndsWhenItIsTold) {
  if (!CutNetwork::IsPossible()) GTEST_SKIP() << "needs network namespaces: root, and iproute2";
  const CutNetwork network;
  const auto service = network.Start(CutNetwork::kRight, {"serve", "--verbose"});
  ASSERT_TRUE(service->WaitUntilItSays("serving as"));
  network.TakeDown(CutNetwork::kRight);
  service->Signal(SIGTERM);
  for (int i = 0; i < 100 && !service->HasEnded(); ++i) std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(service->HasEnded());
}

}  // namespace
}  // namespace qwsm::test
