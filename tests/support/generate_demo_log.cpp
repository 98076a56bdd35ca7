// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// generate_demo_log SCENE LOG [TRUTH]: writes what a robot measured on a drive through a simulated
// scene, as a CARMEN log, and where it really was, as a TUM trajectory in the frame of its first
// pose.
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "service/io/files/atomic_file.hpp"
#include "service/io/logs/carmen_writer.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace {

using namespace qwsm;

constexpr std::string_view kUsage =
    "usage: generate_demo_log SCENE LOG [TRUTH]\n"
    "SCENE is two-rooms, long-corridor or office-loop.\n";

test::Scene SceneNamed(std::string_view name) {
  if (name == "two-rooms") return test::TwoRoomsAndCorridor();
  if (name == "long-corridor") return test::LongCorridor();
  if (name == "office-loop") return test::OfficeLoop();
  throw std::invalid_argument("no scene is called '" + std::string(name) + "'\n" +
                              std::string(kUsage));
}

// Logs begin at some time of day, not at zero.
constexpr Timestamp kStart = std::chrono::seconds(1'000'000'000);

void WriteLog(const test::SimulatedDrive& drive, const char* path) {
  io::AtomicFile file(path);
  io::CarmenWriter writer(file.stream());
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    const Observation& observation = drive.observations[i];
    LaserScan scan = observation.scan;
    scan.stamp += kStart;
    writer.Write(io::TruePoseReading{.stamp = scan.stamp,
                                     .T_world_robot = drive.T_world_robot[i],
                                     .T_odom_robot = observation.T_odom_robot});
    writer.Write(io::ScanReading{
        .scan = std::move(scan), .T_odom_robot = observation.T_odom_robot, .laser = "front"});
  }
  file.Commit();
}

void WriteTruth(const test::SimulatedDrive& drive, const char* path) {
  const Pose2 T_start_world = drive.T_world_robot.front().Inverse();
  Trajectory truth;
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    truth.push_back({.stamp = kStart + drive.observations[i].scan.stamp,
                     .T_map_robot = T_start_world * drive.T_world_robot[i]});
  }
  io::WriteTumFile(path, truth);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << kUsage;
    return 2;
  }
  try {
    const test::SimulatedDrive drive = DriveThrough(SceneNamed(argv[1]), {});
    WriteLog(drive, argv[2]);
    if (argc == 4) WriteTruth(drive, argv[3]);
    std::cerr << drive.observations.size() << " scans in " << argv[2] << '\n';
  } catch (const std::exception& error) {
    std::cerr << "generate_demo_log: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
