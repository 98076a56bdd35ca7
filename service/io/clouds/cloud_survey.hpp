// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "service/io/bags/assembly/bag_survey.hpp"
#include "service/io/clouds/pose_track3.hpp"

namespace slam6d::io {

/// A topic of clouds.
struct CloudTopic {
  std::string frame;
  std::vector<qwsm::io::MessagePlace> places;  ///< In the order of their stamps.
};

/// A topic of odometry.
struct OdometryTopic3 {
  std::string child_frame;
  PoseTrack3 track;
};

/// What a bag holds of 3D scans: read once from begin to end, and kept but for the clouds
/// themselves, as qwsm::io::BagContents has it of scans in the plane.
struct CloudContents {
  std::vector<qwsm::io::OpenBagFile> files;
  std::map<std::string, CloudTopic> clouds;
  std::map<std::string, OdometryTopic3> odometry;
  std::map<std::string, qwsm::io::TransformTree> transforms;  ///< By namespace.
  /// What /tf says of each frame in its parent, by namespace and frame.
  std::map<std::string, std::map<std::string, PoseTrack3>> tracks;
};

/// Reads all messages of a bag. @throws std::runtime_error naming the file where one is no bag.
CloudContents SurveyClouds(const std::filesystem::path& path,
                           qwsm::io::LogReport& report,
                           qwsm::io::BagFaults& faults);

/// The pose that a message tells. @pre qwsm::io::IsSound(transform)
Pose3 PoseOf(const qwsm::io::Transform3& transform);

}  // namespace slam6d::io
