// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

struct dds_qos;

namespace qwsm::dds {

/// What a topic needs of the network. Writers offer much and readers ask for little, so that both
/// match any ROS 2 node (docs/dds.md).
enum class Profile {
  kSensorIn,          ///< Scans, odometry and commands as they come: the newest counts.
  kSensorInWhole,     ///< The same, of writers that repeat what is lost: clouds are large.
  kSensorOut,         ///< The same, from the simulator or a log.
  kAnswer,            ///< Poses, odometry and reports of every scan.
  kAnswerIn,          ///< The same, where each one is wanted.
  kLatched,           ///< The last sample, also for those who come later: maps, graph.
  kLatchedIn,         ///< The same, read.
  kTransforms,        ///< /tf.
  kStaticTransforms,  ///< /tf_static: everybody's, also for those who come later.
  kStaticTransformsOut,
  kSharedScans,  ///< Relevant scans: all there ever were, for services that come later.
};

using Qos = std::unique_ptr<dds_qos, void (*)(dds_qos*)>;

/// The table of all profiles, as a QoS of Cyclone DDS.
Qos QosOf(Profile profile);

}  // namespace qwsm::dds
