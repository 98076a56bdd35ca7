// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A team through the network, as its operator sees it: the simulator, the service and the terminal
// as processes on loopback.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/network.hpp"

namespace qwsm::test {
namespace {

class DdsTeam : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_.path() / name; }

  /// The simulator takes the network as `--network`, for `--set` is of the scenario.
  Outcome Simulate(const std::string& scenario, const std::string& duration_s) const {
    return RunProgram(Simulator(scenario, {"--duration", duration_s}));
  }

  std::vector<std::string> Simulator(const std::string& scenario,
                                     const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{
        "sim", scenario, "--output", Path("driven"), "--quiet", "--dds", "--wait-for-answers"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return network_.JoinSimulator(std::move(arguments));
  }

  /// Where a robot was last in a file of its poses.
  std::pair<double, double> LastPosition_m(const std::string& file) const {
    std::istringstream lines(ReadFile(Path(file)));
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    std::istringstream numbers(last);
    double stamp_s = 0.0;
    std::pair<double, double> p_m;
    numbers >> stamp_s >> p_m.first >> p_m.second;
    return p_m;
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(DdsTeam, FindsAllRobotsOfTheSimulatorInTheFrameOfTheWorld) {
  Daemon service(network_.JoinService({"serve", "--output", Path("served"), "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  const Outcome driven = Simulate("team", "5");
  ASSERT_EQ(driven.exit_code, 0) << driven.errors;
  const Outcome served = service.End();
  ASSERT_EQ(served.exit_code, 0) << served.errors;
  for (const std::string robot : {"robot_1", "robot_2", "robot_3", "robot_4"}) {
    // Not aligned: where they start is part of what is compared.
    const Outcome compared = RunProgram({"eval",
                                         Path("served/" + robot),
                                         "--truth",
                                         Path("driven/" + robot + ".truth.tum"),
                                         "--max-ate",
                                         "0.1"});
    EXPECT_EQ(compared.exit_code, 0) << robot << compared.output << compared.errors;
  }
}

std::size_t CountOf(const std::string& text, const std::string& in) {
  std::size_t count = 0;
  for (std::size_t at = in.find(text); at != std::string::npos; at = in.find(text, at + 1)) ++count;
  return count;
}

// Looks for robots take their time, and give way to all else: they drive until they are found.
TEST_F(DdsTeam, FindsRobotsThatDoNotSayWhereTheyStart) {
  Daemon service(network_.JoinService({"serve", "--output", Path("served"), "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  Program simulator(Simulator("team_unknown", {"--seed", "4", "--speed", "3"}));
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(90);
  const auto all_are_found = [&] { return CountOf(" was found in ", service.ErrorsSoFar()) >= 3; };
  while (!all_are_found() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));  // Each is answered in the map.
  const std::string told = service.ErrorsSoFar();
  simulator.Signal(SIGTERM);
  EXPECT_NE(simulator.Wait().exit_code, 2);
  const Outcome served = service.End();
  ASSERT_EQ(served.exit_code, 0) << served.errors;
  EXPECT_GE(CountOf(" was found in ", served.errors), 3U) << served.errors;
  for (const std::string robot : {"robot_1", "robot_2", "robot_3", "robot_4"}) {
    // Who is lost, because another one stood in its way, or because a busy machine let it wait too
    // long, may not be found again yet.
    if (CountOf(robot + ": is lost: ", told) > 0) continue;
    const auto [x_m, y_m] = LastPosition_m("served/" + robot + "/trajectory.tum");
    const auto [true_x_m, true_y_m] = LastPosition_m("driven/" + robot + ".truth.tum");
    // No room is taken for another one: they are 6 m apart. Within that a robot has drifted that
    // followed another one, of which it did not know where it was.
    EXPECT_LT(std::hypot(x_m - true_x_m, y_m - true_y_m), 3.0) << robot << '\n' << served.errors;
  }
}

TEST_F(DdsTeam, IsWatchedAtAGlance) {
  Daemon service(network_.JoinService({"serve", "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  Daemon watch(network_.Join({"watch", "--period", "0.2", "--verbose"}));
  ASSERT_TRUE(watch.WaitUntilItSays("listening"));
  const Outcome driven = Simulate("team", "2");
  ASSERT_EQ(driven.exit_code, 0) << driven.errors;
  const Outcome watched = watch.End();
  EXPECT_EQ(watched.exit_code, 0) << watched.errors;
  const std::string table = watched.output.substr(watched.output.rfind("robot "));
  EXPECT_NE(table.find("latency ms"), std::string::npos) << table;
  for (const char* robot : {"robot_1", "robot_2", "robot_3", "robot_4"}) {
    EXPECT_NE(table.find(robot), std::string::npos) << table;
  }
  EXPECT_NE(watched.output.find("matched"), std::string::npos) << watched.output;
  // Not on a terminal: nothing is overwritten.
  EXPECT_EQ(watched.output.find('\x1b'), std::string::npos);
}

TEST_F(DdsTeam, WhoWatchesAloneIsToldSo) {
  const Outcome watched = network_.Run({"watch", "--duration", "0.1"});
  EXPECT_EQ(watched.exit_code, 0) << watched.errors;
  EXPECT_EQ(watched.output, "nobody is reported on yet\n");
}

TEST_F(DdsTeam, ServiceSpeaksJsonToTheProgramsThatCollectMessages) {
  Daemon service(network_.JoinService({"serve", "--json", "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0);
  std::istringstream lines(served.errors);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_TRUE(line.starts_with(R"({"time":"2)")) << line;
    EXPECT_NE(line.find(R"("level":")"), std::string::npos) << line;
    EXPECT_TRUE(line.ends_with("\"}")) << line;
  }
  EXPECT_GT(count, 1);
}

TEST_F(DdsTeam, MapIsExportedFromTheNetworkAsFromTheJournal) {
  Daemon service(network_.JoinService({"serve", "--journal", Path("team.db"), "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  const Outcome driven = Simulate("team", "2");
  ASSERT_EQ(driven.exit_code, 0) << driven.errors;
  const Outcome live = network_.Run({"export", "--live", "--geotiff", Path("live")});
  ASSERT_EQ(live.exit_code, 0) << live.errors;
  const Outcome stored = RunProgram({"export", Path("team.db"), "--geotiff", Path("stored")});
  ASSERT_EQ(stored.exit_code, 0) << stored.errors;
  EXPECT_FALSE(ReadFile(Path("live.tfw")).empty());
  EXPECT_EQ(ReadFile(Path("live.tfw")), ReadFile(Path("stored.tfw")));
  EXPECT_EQ(service.End().exit_code, 0);
}

TEST_F(DdsTeam, JournalIsMappedAsALogIs) {
  Daemon service(network_.JoinService({"serve", "--journal", Path("team.db"), "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  const Outcome driven = Simulate("team", "4");
  ASSERT_EQ(driven.exit_code, 0) << driven.errors;
  const Outcome served = service.End();
  ASSERT_EQ(served.exit_code, 0) << served.errors;
  const Outcome mapped = RunProgram({"map", Path("team.db"), "--output", Path("mapped"), "--json"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  EXPECT_TRUE(std::filesystem::exists(Path("mapped/map.png")));
  const std::size_t at = served.output.find(" points of ");
  ASSERT_NE(at, std::string::npos) << served.output;
  // A line for each scan.
  EXPECT_EQ(std::ranges::count(mapped.output, '\n'), std::stoi(served.output.substr(at + 11)));
}

}  // namespace
}  // namespace qwsm::test
