// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/scans/cloud_scan.hpp"

#include "service/team/scans/team_scan.hpp"

namespace qwsm::team {
namespace {

bool IsNear(const slam6d::Pose3& pose) {
  return IsFinite(pose) && pose.translation_m.cwiseAbs().maxCoeff() < kMaxDistance_m;
}

}  // namespace

std::string_view ObjectionTo(const CloudScan& scan) {
  if (scan.cloud.empty()) return "the cloud has no points";
  if (scan.cloud.size() > kMaxCloudPoints) return "the cloud has more than 20 million points";
  if (!IsNear(scan.T_robot_sensor)) return "the sensor's mounting is not finite";
  return {};
}

std::string_view ObjectionTo(const slam6d::UncertainPose3& pose) {
  if (!IsNear(pose.T_a_b)) return "the pose is not finite, or more than 20 km away";
  if (!pose.covariance.allFinite() || pose.covariance.diagonal().minCoeff() < 0.0) {
    return "the covariance is not finite, or its diagonal is negative";
  }
  return {};
}

}  // namespace qwsm::team
