// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "service/team/sinks/service_sink.hpp"

namespace qwsm::team {

/// What a robot's scans have come to: its path, and its model as one cloud.
struct CloudMap {
  struct Stop {
    Timestamp stamp{};
    slam6d::Pose3 T_map_robot;
  };

  std::string_view robot;
  std::vector<Stop> path;    ///< Where each scan was taken, as known by now.
  slam6d::PointCloud cloud;  ///< All clouds in one, thinned.
};

/// Takes what the service for clouds has to tell.
class CloudSink : public ServiceSink<Spatial> {
 public:
  /// Takes a scan of the journal that is in its robot's model once more. It was answered in its
  /// time.
  virtual void TakeRestored(const CloudAnswer&) {}
  virtual void TakeMap(const CloudMap&) {}
};

}  // namespace qwsm::team
