// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/parted_drive.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/logs/log_reader.hpp"

namespace qwsm::test {
namespace {

// The robots begin together, and take turns.
std::vector<sim::Reading> Parted(std::vector<sim::Reading> whole, int robots) {
  const auto parts = static_cast<std::size_t>(robots);
  const std::size_t length = whole.size() / parts;
  std::vector<sim::Reading> parted;
  for (std::size_t i = 0; i < length; ++i) {
    for (std::size_t part = 0; part < parts; ++part) {
      sim::Reading& reading = whole[part * length + i];
      reading.robot = part;
      parted.push_back(std::move(reading));
    }
  }
  return parted;
}

}  // namespace

std::vector<sim::Reading> PartedLog(const std::filesystem::path& path, int robots) {
  std::vector<sim::Reading> whole;
  SelfCorrectingMapper mapper;
  const auto log = io::OpenLog(path);
  while (const auto record = log->Next()) {
    const auto* reading = std::get_if<io::ScanReading>(&*record);
    if (reading == nullptr || !reading->T_odom_robot) continue;
    mapper.Process({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    sim::Reading taken;
    taken.scan = reading->scan;
    taken.T_odom_robot = *reading->T_odom_robot;
    whole.push_back(std::move(taken));
  }
  const std::vector<UncertainPose2> map_robot = mapper.Correct().map_robot;
  for (std::size_t i = 0; i < whole.size(); ++i) whole[i].T_world_robot = map_robot[i].T_a_b;
  return Parted(std::move(whole), robots);
}

std::vector<sim::Reading> PartedDrive(const sim::ScenarioOptions& scenario, int robots) {
  std::vector<sim::Reading> whole;
  sim::Simulation simulation(scenario);
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    whole.push_back(std::move(*reading));
  }
  return Parted(std::move(whole), robots);
}

}  // namespace qwsm::test
