// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/profile.hpp"

#include <dds/dds.h>

namespace qwsm::dds {
namespace {

struct Terms {
  bool reliable;
  bool latched;  ///< Transient local: kept for readers that come later.
  int depth;
};

// History of shared scans: three days of a robot that makes one relevant scan each second.
constexpr int kAllSharedScans = 262'144;

// Some seconds of a sensor of 400 Hz.
constexpr int kSecondsOfSamples = 1024;

// More than any writer says while the disk is busy for a moment.
constexpr int kManySamples = 4096;

constexpr Terms TermsOf(Profile profile) {
  switch (profile) {
    case Profile::kSensorIn:
      return {.reliable = false, .latched = false, .depth = 32};
    case Profile::kSensorInWhole:
    case Profile::kSensorOut:
      return {.reliable = true, .latched = false, .depth = 32};
    case Profile::kFastSensorIn:
      return {.reliable = false, .latched = false, .depth = kSecondsOfSamples};
    case Profile::kFastSensorOut:
      return {.reliable = true, .latched = false, .depth = kSecondsOfSamples};
    case Profile::kAnswer:
    case Profile::kAnswerIn:
      return {.reliable = true, .latched = false, .depth = 256};
    case Profile::kLatched:
    case Profile::kLatchedIn:
    case Profile::kStaticTransformsOut:
      return {.reliable = true, .latched = true, .depth = 1};
    case Profile::kTransforms:
      return {.reliable = true, .latched = false, .depth = 100};
    case Profile::kStaticTransforms:  // All writers share its history.
      return {.reliable = true, .latched = true, .depth = kManySamples};
    case Profile::kRecorded:
      return {.reliable = false, .latched = false, .depth = kManySamples};
    case Profile::kRecordedWhole:
      return {.reliable = true, .latched = false, .depth = kManySamples};
    case Profile::kMarks:
      return {.reliable = true, .latched = true, .depth = 1024};
    case Profile::kRecordedLatched:
    case Profile::kSharedScans:
    case Profile::kSharedScansIn:
    case Profile::kSharedScansOfOthers:
      return {.reliable = true, .latched = true, .depth = kAllSharedScans};
  }
  return {};
}

}  // namespace

Qos QosOf(Profile profile) {
  const Terms terms = TermsOf(profile);
  Qos qos(dds_create_qos(), dds_delete_qos);
  // A reader that hangs must not hang its writers: they wait for it no longer than that.
  dds_qset_reliability(qos.get(),
                       terms.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, terms.depth);
  if (terms.latched) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(),
                                0,
                                DDS_HISTORY_KEEP_LAST,
                                terms.depth,
                                DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
  }
  // A service knows its own scans.
  if (profile == Profile::kSharedScansOfOthers) {
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  }
  return qos;
}

}  // namespace qwsm::dds
