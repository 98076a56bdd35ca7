// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

struct dds_qos;

namespace qwsm::dds {

/// What a topic needs of the network. Writers offer much and readers ask for little, so that both
/// match any ROS 2 node (docs/dds.md).
enum class Profile {
  kSensorIn,       ///< Reads scans, odometry and commands: the newest counts.
  kSensorInWhole,  ///< Reads clouds of writers that repeat what is lost: clouds are large.
  kSensorOut,      ///< Writes scans, odometry and commands, from the simulator or a log.
  kFastSensorIn,   ///< Reads what comes some hundred times a second, where each one counts.
  kFastSensorOut,  ///< Writes it.
  kAnswer,         ///< Writes poses, odometry and reports of every scan.
  kAnswerIn,       ///< Reads poses, odometry and reports where each one is wanted.
  kLatched,        ///< Writes maps and the graph: the last sample is kept for those who come later.
  kLatchedIn,      ///< Reads maps and the graph, the last sample at once.
  kTransforms,     ///< Writes /tf.
  kStaticTransforms,  ///< Reads /tf_static: what everybody has said, also before the reader came.
  kStaticTransformsOut,
  kRecorded,         ///< Reads whatever is published, to be kept: nothing is to be overwritten.
  kRecordedWhole,    ///< The same of writers that repeat what is lost.
  kRecordedLatched,  ///< The same with what was published before.
  kMarks,  ///< Reads and writes marks on the map: all there ever were, for who comes later.
  /// Writes relevant scans: all there ever were, for services that come later.
  kSharedScans,
  kSharedScansIn,        ///< Reads all relevant scans.
  kSharedScansOfOthers,  ///< Reads the relevant scans of other participants.
};

using Qos = std::unique_ptr<dds_qos, void (*)(dds_qos*)>;

/// The QoS of a profile for Cyclone DDS; one table holds all of them.
Qos QosOf(Profile profile);

}  // namespace qwsm::dds
