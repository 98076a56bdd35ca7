// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot_discovery.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "service/dds/robot_names.hpp"

namespace qwsm::dds {
namespace {

constexpr std::size_t kBatch = 32;

Guid ToGuid(const dds_guid_t& raw) {
  Guid guid{};
  std::ranges::copy(raw.v, guid.begin());
  return guid;
}

bool OffersReliability(const dds_builtintopic_endpoint_t& endpoint) {
  dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
  dds_duration_t longest_wait = 0;
  return dds_qget_reliability(endpoint.qos, &kind, &longest_wait) &&
         kind == DDS_RELIABILITY_RELIABLE;
}

}  // namespace

RobotDiscovery::RobotDiscovery(const Participant& participant, std::string part, std::string type)
    : part_(std::move(part)),
      type_(std::move(type)),
      reader_(dds_create_reader(
                  participant.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
              "discovery") {
  dds_set_status_mask(handle(), DDS_DATA_AVAILABLE_STATUS);
}

RobotDiscovery::Changes RobotDiscovery::Take() {
  Changes changes;
  std::array<void*, kBatch> samples{};
  std::array<dds_sample_info_t, kBatch> infos{};
  while (true) {
    const dds_return_t count = dds_take(handle(), samples.data(), infos.data(), kBatch, kBatch);
    if (count <= 0) return changes;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      Note(samples[i], infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE, changes);
    }
    dds_return_loan(handle(), samples.data(), count);
  }
}

// Of a publisher that is gone only the key is known.
void RobotDiscovery::Note(const void* publication, bool is_alive, Changes& changes) {
  const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(publication);
  const Guid guid = ToGuid(endpoint.key);
  if (!is_alive) {
    const auto gone = robot_of_.extract(guid);
    if (!gone || --publishers_of_[gone.mapped()] > 0) return;
    unreliable_.erase(gone.mapped());
    changes.left.push_back(gone.mapped());
    return;
  }
  if (robot_of_.contains(guid) || endpoint.type_name != type_) return;
  const std::optional<std::string> robot = RobotNames::RobotOf(endpoint.topic_name, part_);
  if (!robot) return;
  robot_of_[guid] = *robot;
  if (!OffersReliability(endpoint)) unreliable_.insert(*robot);
  if (++publishers_of_[*robot] == 1) changes.joined.push_back(*robot);
}

}  // namespace qwsm::dds
