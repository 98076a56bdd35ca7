// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario.hpp"

#include <algorithm>
#include <utility>

#include "inspection.hpp"
#include "placement.hpp"

namespace sim {
namespace {

std::string Lines(const std::vector<ScenarioProblem>& problems) {
  std::string text;
  for (const ScenarioProblem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.key + ": " + problem.what;
  }
  return text;
}

std::string KeyOfRobot(std::size_t index) { return "robots[" + std::to_string(index) + "]"; }

void FindMissingWays(const ScenarioOptions& scenario, std::vector<ScenarioProblem>& problems) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const bool has_way = scenario.layout.kind != LayoutKind::kEmpty ||
                         !TakesRouteOfLayout(scenario.robots[i].driver);
    if (has_way) continue;
    problems.push_back({KeyOfRobot(i) + ".driver.waypoints",
                        "needed, since an empty layout has no way of its own"});
  }
}

void FindSharedNames(const ScenarioOptions& scenario, std::vector<ScenarioProblem>& problems) {
  for (auto robot = scenario.robots.begin(); robot != scenario.robots.end(); ++robot) {
    const auto has_its_name = [&](const RobotOptions& other) { return other.name == robot->name; };
    if (std::none_of(scenario.robots.begin(), robot, has_its_name)) continue;
    const auto index = static_cast<std::size_t>(robot - scenario.robots.begin());
    problems.push_back(
        {KeyOfRobot(index) + ".name", "another robot is called '" + robot->name + "' too"});
  }
}

// Whoever begins inside a robot throws it aside, which neither wheels nor gyro would tell of.
void FindOccupiedPersons(const ScenarioOptions& scenario,
                         const PhysicsWorld& world,
                         std::vector<ScenarioProblem>& problems) {
  for (std::size_t i = 0; i < scenario.scenery.persons.size(); ++i) {
    const PersonOptions& person = scenario.scenery.persons[i];
    const WaypointOptions& start = person.waypoints.front();
    if (!world.IsOccupied(Disc{person.radius_m}, {start.x_m, start.y_m, 0.0})) continue;
    problems.push_back({"scenery.persons[" + std::to_string(i) + "].waypoints",
                        "the person would start inside a wall, a thing or a robot"});
  }
}

void FindOccupiedStarts(const ScenarioOptions& scenario, std::vector<ScenarioProblem>& problems) {
  const Place place = FullPlace(scenario);
  PhysicsWorld world;
  Build(place.scenery, world);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotPlacement placement = PlacementOf(scenario, place, i);
    const Rectangle outline{placement.options.length_m, placement.options.width_m};
    if (world.IsOccupied(outline, placement.T_world_robot)) {
      const bool is_given = !TakesRouteOfLayout(placement.options.driver);
      problems.push_back({KeyOfRobot(i) + (is_given ? ".start_x_m" : ".driver"),
                          "the robot would start inside a wall, a thing or another robot"});
    }
    world.AddFixed(outline, placement.T_world_robot);
  }
  FindOccupiedPersons(scenario, world, problems);
}

}  // namespace

ScenarioError::ScenarioError(std::vector<ScenarioProblem> problems)
    : std::invalid_argument(Lines(problems)), problems_(std::move(problems)) {}

std::vector<ScenarioProblem> FindProblems(const ScenarioOptions& scenario) {
  ScenarioOptions copy = scenario;  // Describe() takes options that could be changed.
  Inspection inspection;
  inspection.Inspect(copy);
  return inspection.Take();
}

std::vector<ScenarioProblem> FindProblemsOfTheWhole(const ScenarioOptions& scenario) {
  std::vector<ScenarioProblem> problems;
  if (scenario.robots.empty()) problems.push_back({"robots", "a scenario needs one at least"});
  FindSharedNames(scenario, problems);
  FindMissingWays(scenario, problems);
  // Only a world that can be built is built, to see whether the robots have room in it.
  if (problems.empty()) FindOccupiedStarts(scenario, problems);
  return problems;
}

}  // namespace sim
