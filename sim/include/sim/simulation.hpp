// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/ground.hpp"
#include "sim/person.hpp"
#include "sim/physics_world.hpp"
#include "sim/robot.hpp"
#include "sim/scenario.hpp"

namespace sim {

/// Runs a scenario in simulated time, from 0 on, as fast as it is asked to. The same scenario gives
/// the same readings, bit for bit.
class Simulation {
 public:
  static constexpr std::chrono::nanoseconds kStep = std::chrono::milliseconds(10);

  /// Sets up a scenario. @throws ScenarioError naming everything wrong with the scenario.
  explicit Simulation(const ScenarioOptions& scenario);

  /// The next complete scan of any robot, in the order of completion; nothing once the simulation
  /// is over.
  std::optional<Reading> Next();

  /// Advances by one step and returns the scans completed by its end; the first call returns the
  /// scans taken at time 0 and advances nothing. The span is valid until the next call.
  std::span<const Reading> Step();

  /// Whether the duration is up or every robot has arrived.
  bool is_over() const;

  /// Share of the simulation that is over, 0..1, by the time or by the way of the robot that is
  /// last.
  double share_done() const;

  /// Sets what an external driver asks for until told otherwise.
  /// @pre robot < robots().size()
  void SetCommand(std::size_t robot, const VelocityCommand& command);

  qwsm::Timestamp now() const { return now_; }
  qwsm::Pose2 T_world_robot(std::size_t robot) const;
  Twist2 MotionOf(std::size_t robot) const;

  const std::vector<Robot>& robots() const { return robots_; }
  const std::vector<Person>& persons() const { return persons_; }
  const PhysicsWorld& world() const { return world_; }

  /// All that was put up, by the scenario and by its layout.
  const SceneryOptions& scenery() const { return place_.scenery; }

 private:
  void Advance();

  ScenarioOptions scenario_;
  Place place_;
  PhysicsWorld world_;
  Ground ground_;
  std::vector<Person> persons_;
  std::vector<Robot> robots_;
  qwsm::Timestamp now_{};
  bool has_begun_ = false;
  std::vector<Reading> completed_;  ///< Readings completed in the last step.
  std::size_t taken_ = 0;           ///< How many of `completed_` Next() has given.
};

}  // namespace sim
