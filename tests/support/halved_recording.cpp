// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/halved_recording.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/logs/log_reader.hpp"
#include "qwsm/mapping/grid_survey.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

constexpr std::size_t kParts = 20;

/// A relevant scan, and which of the observations it is.
struct RelevantObservation {
  std::size_t index = 0;
  LaserScan scan;
};

ScanMap MapOf(const HalvedRecording& recording, const std::vector<RelevantObservation>& relevant) {
  ScanMap map;
  for (const auto& [index, scan] : relevant) {
    if (!recording.is_of_map[index]) continue;
    map.Insert(scan, ToPoints(scan), {.T_a_b = recording.T_map_robot[index]});
  }
  return map;
}

}  // namespace

std::vector<double> HalvedRecording::DistancesToMap_m() const {
  std::vector<double> distances_m;
  for (const Pose2& T_map_this : T_map_robot) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const RelevantScan& scan : map.scans()) {
      const Pose2& T_map_scan = scan.map_robot.T_a_b;
      nearest_m =
          std::min(nearest_m, (T_map_scan.translation_m() - T_map_this.translation_m()).norm());
    }
    distances_m.push_back(nearest_m);
  }
  return distances_m;
}

HalvedRecording HalvedLog(const std::filesystem::path& path) {
  HalvedRecording recording;
  SelfCorrectingMapper mapper;
  std::vector<RelevantObservation> relevant;
  const auto log = io::OpenLog(path);
  while (const auto record = log->Next()) {
    const auto* reading = std::get_if<io::ScanReading>(&*record);
    if (reading == nullptr) continue;
    recording.observations.push_back(
        {.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    MappingStep step = mapper.Process(recording.observations.back());
    if (!step.relevant) continue;
    relevant.push_back({recording.observations.size() - 1, std::move(step.relevant_scan)});
  }
  for (const UncertainPose2& map_robot : mapper.Correct().map_robot) {
    const std::size_t part = recording.T_map_robot.size() * kParts / recording.observations.size();
    recording.is_of_map.push_back(part % 2 == 0);
    recording.T_map_robot.push_back(map_robot.T_a_b);
  }
  recording.map = MapOf(recording, relevant);
  return recording;
}

// The mapper only chooses the scans that are worth keeping, without what moves.
HalvedRecording HalvedDrive(const sim::ScenarioOptions& scenario) {
  HalvedRecording recording;
  sim::Simulation simulation(scenario);
  Mapper mapper;
  std::vector<RelevantObservation> relevant;
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    recording.observations.push_back(
        {.scan = std::move(reading->scan), .T_odom_robot = reading->T_odom_robot});
    recording.T_map_robot.push_back(reading->T_world_robot);
    MappingStep step = mapper.Process(recording.observations.back());
    if (!step.relevant) continue;
    relevant.push_back({recording.observations.size() - 1, std::move(step.relevant_scan)});
  }
  recording.is_of_map.resize(recording.observations.size(), false);
  std::fill_n(recording.is_of_map.begin(), recording.is_of_map.size() / 2, true);
  recording.map = MapOf(recording, relevant);
  return recording;
}

void MakeForeign(HalvedRecording& recording, double cell_m) {
  const OccupancyGridResult drawn = RenderOccupancyGrid(recording.map.scans(), {.cell_m = cell_m});
  if (drawn.status != RenderStatus::kRendered) throw std::invalid_argument("the map has no grid");
  recording.map = SurveyGrid(drawn.grid);
}

sim::ScenarioOptions CorridorThereAndBack() {
  return sim::testing::Drive(sim::LayoutKind::kCorridor, 1);
}

sim::ScenarioOptions OfficeTwice() {
  sim::ScenarioOptions office = sim::testing::Drive(sim::LayoutKind::kOffice, 1);
  office.robots.front().driver.laps = 2;
  return office;
}

sim::ScenarioOptions AlikeCorridors() {
  sim::ScenarioOptions corridors = sim::testing::Drive(sim::LayoutKind::kCorridor, 1);
  corridors.layout.corridor = {.zigzag_legs = 100, .zigzag_leg_m = 15.0, .straight_m = 0.0};
  sim::RobotOptions& robot = corridors.robots.front();
  robot.driver.speed_mps = 1.0;
  robot.laser.rate_hz = 5.0;
  return corridors;
}

}  // namespace qwsm::test
