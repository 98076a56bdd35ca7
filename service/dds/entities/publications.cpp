// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/publications.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <memory>

namespace qwsm::dds {
namespace {

constexpr std::size_t kPublicationBatch = 32;

Guid ToGuid(const dds_guid_t& raw) {
  Guid guid{};
  std::ranges::copy(raw.v, guid.begin());
  return guid;
}

bool OffersReliability(const dds_qos_t* qos) {
  dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
  dds_duration_t longest_wait = 0;
  return dds_qget_reliability(qos, &kind, &longest_wait) && kind == DDS_RELIABILITY_RELIABLE;
}

bool KeepsSamples(const dds_qos_t* qos) {
  dds_durability_kind_t kind = DDS_DURABILITY_VOLATILE;
  return dds_qget_durability(qos, &kind) && kind != DDS_DURABILITY_VOLATILE;
}

void Tell(const dds_builtintopic_endpoint_t& endpoint,
          bool is_alive,
          const std::function<void(const Publication&)>& take) {
  Publication publication{.writer = ToGuid(endpoint.key), .is_alive = is_alive};
  // Of a writer that is gone only the key is there.
  if (!is_alive) return take(publication);
  void* value = nullptr;
  std::size_t size = 0;
  dds_qget_userdata(endpoint.qos, &value, &size);
  const std::unique_ptr<void, void (*)(void*)> owned(value, dds_free);
  if (value != nullptr) publication.user_data = {static_cast<const char*>(value), size};
  publication.participant = ToGuid(endpoint.participant_key);
  publication.topic = endpoint.topic_name;
  publication.type = endpoint.type_name;
  publication.is_reliable = OffersReliability(endpoint.qos);
  publication.is_latched = KeepsSamples(endpoint.qos);
  take(publication);
}

}  // namespace

Publications::Publications(const Participant& participant)
    : reader_(dds_create_reader(
                  participant.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
              "discovery") {
  dds_set_status_mask(handle(), DDS_DATA_AVAILABLE_STATUS);
}

std::size_t Publications::TakeAll(const std::function<void(const Publication&)>& take) const {
  std::array<void*, kPublicationBatch> samples{};
  std::array<dds_sample_info_t, kPublicationBatch> infos{};
  std::size_t taken = 0;
  while (true) {
    const dds_return_t count =
        dds_take(handle(), samples.data(), infos.data(), kPublicationBatch, kPublicationBatch);
    if (count <= 0) return taken;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      Tell(*static_cast<const dds_builtintopic_endpoint_t*>(samples[i]),
           infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE,
           take);
    }
    dds_return_loan(handle(), samples.data(), count);
    taken += static_cast<std::size_t>(count);
  }
}

}  // namespace qwsm::dds
