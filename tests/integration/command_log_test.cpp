// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Recorded drives: a log of commands is played back, and refused where it is wrong.
#include "service/pipeline/simulation/command_log.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "service/config/problem.hpp"
#include "sim/simulation.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class CommandLog : public ::testing::Test {
 protected:
  fs::path Write(const std::string& text, const std::string& name = "drive.commands") const {
    const fs::path file = folder_.path() / name;
    std::ofstream(file) << text;
    return file;
  }

  std::string Complaint(const std::string& text) const {
    const fs::path file = Write(text);
    try {
      pipeline::ReadCommandLog(file);
    } catch (const config::ConfigError& error) {
      std::string what = error.what();
      const std::string name = file.string();
      for (std::size_t at; (at = what.find(name)) != std::string::npos;) {
        what.replace(at, name.size(), "LOG");
      }
      return what;
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

TEST_F(CommandLog, BeginsWithItsFirstLine) {
  const auto commands = pipeline::ReadCommandLog(
      Write("# joystick\n\n1700000000.5 0.5 0\n1700000002.5,\t0.25, -0.1  # slower\r\n"));
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].start_s, 0.0);
  EXPECT_EQ(commands[0].forward_mps, 0.5);
  EXPECT_EQ(commands[1].start_s, 2.0);
  EXPECT_EQ(commands[1].forward_mps, 0.25);
  EXPECT_EQ(commands[1].turn_rad_s, -0.1);
}

TEST_F(CommandLog, IsRefusedWithEveryLineThatIsWrong) {
  EXPECT_EQ(Complaint("0 0.5 0\n"
                      "1 fast 0\n"
                      "2 0.5\n"
                      "0.5 0.1 0\n"
                      "-1 0.5 0\n"
                      "3 21 0\n"
                      "4 0.5 0 7\n"),
            "LOG:2:3: 'fast' is not a number\n"
            "LOG:3:1: must be 'stamp forward turn', in s, m/s, rad/s\n"
            "LOG:5:1: earlier than the command before; stamps must not decrease\n"
            "LOG:6:1: speeds must be between -20 and 20 m/s, rad/s\n"
            "LOG:7:9: more than 'stamp forward turn'");
  EXPECT_EQ(Complaint("# nothing\n"), "LOG: holds no commands: lines of 'stamp forward turn'");
}

TEST_F(CommandLog, IsFoundBesideTheScenarioAndDriven) {
  Write("10 0.5 0\n20 0 0\n22 0 0\n");
  sim::ScenarioOptions scenario = sim::testing::EmptyFloor();
  scenario.robots[0].driver = {.kind = sim::DriverKind::kRecorded, .command_log = "drive.commands"};
  pipeline::ReadCommandLogs(folder_.path(), scenario);
  EXPECT_EQ(scenario.robots[0].driver.command_log, "");
  sim::Simulation simulation(scenario);
  while (!simulation.is_over()) simulation.Step();
  EXPECT_NEAR(simulation.T_world_robot(0).x_m, 5.0, 0.1);
  EXPECT_NEAR(std::chrono::duration<double>(simulation.now()).count(), 12.0, 0.1);
}

TEST_F(CommandLog, ShippedDriveComesRoundAndCanBeGivenAgain) {
  const fs::path first = folder_.path() / "first";
  const Outcome drive = RunProgram({"sim", "joystick", "--output", first, "--quiet"});
  ASSERT_EQ(drive.exit_code, 0) << drive.errors;
  const fs::path again = folder_.path() / "again";
  ASSERT_EQ(RunProgram({"sim", first / "scenario.yaml", "--output", again, "-q"}).exit_code, 0);
  EXPECT_EQ(ReadFile(first / "robot.truth.tum"), ReadFile(again / "robot.truth.tum"));
}

TEST_F(CommandLog, MissingOneIsNamed) {
  const fs::path scenario =
      Write("robots: [{driver: {kind: recorded, command_log: lost.commands}}]\n", "a.yaml");
  const Outcome outcome = RunProgram({"sim", scenario, "--output", folder_.path() / "results"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("lost.commands: cannot be opened"), std::string::npos)
      << outcome.errors;
  EXPECT_FALSE(fs::exists(folder_.path() / "results"));
}

}  // namespace
}  // namespace qwsm::test
