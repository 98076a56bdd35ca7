// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/ground.hpp"
#include "sim/layouts/layout.hpp"
#include "sim/robot.hpp"
#include "sim/scenery.hpp"

namespace sim {

/// A world, its robots, and how they drive. Lengths are in the world's frame.
struct ScenarioOptions {
  int seed = 1;  ///< Seed of everything random: places, noise, patches of ground, drivers.
  /// Longest duration; the run ends earlier once every robot has arrived.
  double duration_s = 3600.0;
  LayoutOptions layout;
  SceneryOptions scenery;  ///< Scenery in addition to what the layout puts up.
  GroundOptions ground;
  std::vector<RobotOptions> robots;
};

template <class Visitor>
void Describe(Visitor& visit, ScenarioOptions& o) {
  visit("seed", o.seed, {.help = "of everything random", .min = 0, .max = 2147483647});
  visit(
      "duration_s",
      o.duration_s,
      {.help = "simulated time; ends earlier once every robot has arrived", .min = 0, .max = 1e6});
  visit("layout", o.layout, {.help = "a place laid out by rule"});
  visit("scenery", o.scenery, {.help = "walls, boxes, round things and people to add"});
  visit("ground", o.ground, {.help = "what the wheels run on"});
  visit("robots", o.robots, {.help = "the robots"});
}

/// One thing wrong with a scenario, and the option it is about, such as `robots[1].laser.beams`.
struct ScenarioProblem {
  std::string key;
  std::string what;
};

/// Tells of a scenario that cannot be run. what() has one line per problem.
class ScenarioError : public std::invalid_argument {
 public:
  explicit ScenarioError(std::vector<ScenarioProblem> problems);
  const std::vector<ScenarioProblem>& problems() const { return problems_; }

 private:
  std::vector<ScenarioProblem> problems_;
};

/// All that is wrong with a scenario: values out of bounds, what contradicts another option, and
/// robots that start inside something.
std::vector<ScenarioProblem> FindProblems(const ScenarioOptions& scenario);

/// Problems that only the scenario as a whole shows.
/// @pre every value is within its bounds
std::vector<ScenarioProblem> FindProblemsOfTheWhole(const ScenarioOptions& scenario);

template <class Report>
void Validate(const ScenarioOptions& o, Report& report) {
  for (const ScenarioProblem& problem : FindProblemsOfTheWhole(o)) {
    report(problem.key, problem.what);
  }
}

}  // namespace sim
