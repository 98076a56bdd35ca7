// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation.hpp"

#include <algorithm>
#include <cassert>
#include <string>

#include "placement.hpp"

namespace sim {
namespace {

std::uint64_t SeedOf(const ScenarioOptions& scenario) {
  return static_cast<std::uint64_t>(scenario.seed);
}

const ScenarioOptions& Checked(const ScenarioOptions& scenario) {
  std::vector<ScenarioProblem> problems = FindProblems(scenario);
  if (!problems.empty()) throw ScenarioError(std::move(problems));
  return scenario;
}

}  // namespace

Simulation::Simulation(const ScenarioOptions& scenario)
    : scenario_(Checked(scenario)),
      place_(FullPlace(scenario)),
      ground_(scenario.ground, SeedFor("ground", SeedOf(scenario))) {
  Build(place_.scenery, world_);
  const std::uint64_t seed = SeedOf(scenario);
  for (const PersonOptions& person : place_.scenery.persons) {
    const std::string purpose = "person " + std::to_string(persons_.size());
    persons_.emplace_back(person, world_, SeedFor(purpose, seed));
  }
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const std::string purpose = "robot " + std::to_string(i);
    robots_.emplace_back(PlacementOf(scenario, place_, i), SeedFor(purpose, seed), world_);
  }
}

std::optional<Reading> Simulation::Next() {
  while (taken_ == completed_.size()) {
    if (has_begun_ && is_over()) return std::nullopt;
    Step();
  }
  return completed_[taken_++];
}

std::span<const Reading> Simulation::Step() {
  if (has_begun_) Advance();
  has_begun_ = true;
  completed_.clear();
  taken_ = 0;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::size_t before = completed_.size();
    robots_[i].Scan(world_, now_, completed_);
    for (std::size_t k = before; k < completed_.size(); ++k) completed_[k].robot = i;
  }
  return completed_;
}

void Simulation::Advance() {
  for (Person& person : persons_) person.Walk(world_, now_);
  for (Robot& robot : robots_) robot.Drive(world_, ground_, now_, kStep);
  world_.Step(kStep);
  now_ += kStep;
  for (Robot& robot : robots_) robot.Advance(world_, now_, kStep);
}

bool Simulation::is_over() const {
  const std::chrono::duration<double> elapsed = now_;
  if (elapsed.count() >= scenario_.duration_s) return true;
  return std::ranges::all_of(robots_,
                             [](const Robot& robot) { return robot.driver().has_arrived(); });
}

double Simulation::share_done() const {
  const std::chrono::duration<double> elapsed = now_;
  double of_ways = 1.0;
  for (const Robot& robot : robots_) of_ways = std::min(of_ways, robot.driver().share_done());
  const double of_time =
      scenario_.duration_s > 0.0 ? std::min(1.0, elapsed.count() / scenario_.duration_s) : 1.0;
  return std::max(of_time, of_ways);
}

void Simulation::SetCommand(std::size_t robot, const VelocityCommand& command) {
  assert(robot < robots_.size() && "the scenario has such a robot");
  robots_[robot].driver().SetCommand(command);
}

qwsm::Pose2 Simulation::T_world_robot(std::size_t robot) const {
  assert(robot < robots_.size() && "the scenario has such a robot");
  return world_.PoseOf(robots_[robot].body());
}

Twist2 Simulation::MotionOf(std::size_t robot) const {
  assert(robot < robots_.size() && "the scenario has such a robot");
  return world_.TwistOf(robots_[robot].body());
}

}  // namespace sim
