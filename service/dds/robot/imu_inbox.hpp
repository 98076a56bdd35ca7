// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "service/dds/entities/reader.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/session/robot_listener.hpp"

namespace qwsm::dds {

/// Hears the inertial sensor of one robot, and turns what it says to the robot's axes.
class ImuInbox {
 public:
  /// Says how a frame is turned on the robot; nothing where that is not known.
  using FindRotation = std::function<std::optional<Quaternion>(const std::string& frame)>;

  /// Subscribes. @param refusals outlives this.
  ImuInbox(const Participant& participant, const RobotNames& names, Refusals& refusals);

  Entity::Handle handle() const { return reader_.handle(); }
  /// Whether there are readings that wait to be told how their sensor is mounted.
  bool is_waiting() const { return !waiting_.empty(); }

  /// Delivers what has arrived. Readings wait a second for who knows how their sensor is mounted;
  /// after that it is taken as upright.
  void Deliver(const FindRotation& find, team::RobotListener<team::Planar>& listener);

 private:
  struct Waiting {
    ImuReading reading;
    std::string frame;
  };
  using Clock = std::chrono::steady_clock;

  void Take(const wire::Imu& sample);

  RobotNames names_;
  Refusals& refusals_;
  Reader<wire::Imu> reader_;
  std::deque<Waiting> waiting_;
  std::optional<Clock::time_point> waits_since_;
  bool takes_unmounted_ = false;  // Nobody says how the sensor is mounted, and nobody will.
};

}  // namespace qwsm::dds
