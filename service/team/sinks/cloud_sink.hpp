// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/scans/cloud_scan.hpp"
#include "service/team/sinks/team_sink.hpp"
#include "service/team/sinks/team_status.hpp"
#include "slam6d/mapping/slam.hpp"

namespace qwsm::team {

/// The answer to one 3D scan.
struct CloudAnswer {
  std::string robot;
  std::shared_ptr<const CloudScan> scan;
  slam6d::SlamStep step;                        ///< Of the sensor's pose.
  slam6d::Pose3 T_odom_sensor;                  ///< The estimate that the registration began with.
  slam6d::UncertainPose3 map_robot;             ///< Where the scan says the robot is.
  std::optional<slam6d::Pose3> T_odom_robot{};  ///< At the scan's stamp, as odometry has it.
  std::chrono::nanoseconds matching{};          ///< Time the registration took.
  std::chrono::nanoseconds latency{};           ///< From the scan's arrival to now.
  std::uint64_t scans = 0;                      ///< Of this robot so far.
  std::uint64_t dropped = 0;                    ///< Of these, because the queue was full.
};

/// What a robot's scans have come to.
struct CloudMap {
  struct Stop {
    Timestamp stamp{};
    slam6d::Pose3 T_map_robot;
  };

  std::string_view robot;
  std::vector<Stop> path;    ///< Where each scan was taken, as known by now.
  slam6d::PointCloud cloud;  ///< All of them, thinned.
};

/// Takes what the service has to tell, as TeamSink.
class CloudSink {
 public:
  CloudSink() = default;
  CloudSink(const CloudSink&) = delete;
  CloudSink& operator=(const CloudSink&) = delete;
  virtual ~CloudSink() = default;

  /// A pose, as soon as it is known.
  virtual void TakeAnswer(const CloudAnswer& answer) = 0;
  /// The same again, once the scan is safely in the journal, if there is one that can be written.
  virtual void TakeReport(const CloudAnswer& answer) = 0;
  /// A scan of the journal is in its robot's model once more. It was answered in its time.
  virtual void TakeRestored(const CloudAnswer& answer) = 0;
  virtual void TakeMap(const CloudMap& map) = 0;
  virtual void TakeStatus(const TeamStatus& status) = 0;
  virtual void TakeEvent(const TeamEvent& event) = 0;
};

}  // namespace qwsm::team
