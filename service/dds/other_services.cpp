// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/other_services.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "service/dds/robot_discovery.hpp"
#include "service/dds/robot_names.hpp"

namespace qwsm::dds {
namespace {

constexpr std::size_t kBatch = 32;
constexpr std::string_view kKey = "claim=";

Guid ToGuid(const dds_guid_t& raw) {
  Guid guid{};
  std::ranges::copy(raw.v, guid.begin());
  return guid;
}

/// A service that says nothing of a claim does not look for robots: it was told to.
std::uint64_t SinceOf(const dds_qos_t* qos) {
  void* value = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &value, &size) || value == nullptr) return 0;
  const std::string text(static_cast<const char*>(value), size);
  dds_free(value);
  const std::size_t at = text.find(kKey);
  std::uint64_t since_ns = 0;
  if (at != std::string::npos) {
    std::from_chars(text.data() + at + kKey.size(), text.data() + text.size(), since_ns);
  }
  return since_ns;
}

}  // namespace

std::string ToUserData(const Claim& claim) {
  return std::string(kKey) + std::to_string(claim.since_ns) + ";";
}

OtherServices::OtherServices(const Participant& participant)
    : own_(participant.guid()),
      reader_(dds_create_reader(
                  participant.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
              "discovery of services") {
  dds_set_status_mask(handle(), DDS_DATA_AVAILABLE_STATUS);
}

void OtherServices::Update() {
  std::array<void*, kBatch> samples{};
  std::array<dds_sample_info_t, kBatch> infos{};
  while (true) {
    const dds_return_t count = dds_take(handle(), samples.data(), infos.data(), kBatch, kBatch);
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      Note(samples[i], infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE);
    }
    dds_return_loan(handle(), samples.data(), count);
  }
}

// Of a writer that is gone only the key is known.
void OtherServices::Note(const void* publication, bool is_alive) {
  const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(publication);
  const Guid writer = ToGuid(endpoint.key);
  if (!is_alive) {
    answerers_.erase(writer);
    return;
  }
  const Guid service = ToGuid(endpoint.participant_key);
  if (service == own_ || endpoint.type_name != std::string_view(kMatchReportType)) return;
  const std::optional<std::string> robot = RobotNames::RobotOf(endpoint.topic_name, kReportTopic);
  if (!robot) return;
  answerers_[writer] = {.robot = *robot,
                        .claim = {.since_ns = SinceOf(endpoint.qos), .service = service}};
}

bool OtherServices::Answer(std::string_view robot) const {
  return std::ranges::any_of(answerers_,
                             [&](const auto& known) { return known.second.robot == robot; });
}

bool OtherServices::HaveBetterClaim(std::string_view robot, const Claim& claim) const {
  return std::ranges::any_of(answerers_, [&](const auto& known) {
    return known.second.robot == robot && known.second.claim < claim;
  });
}

}  // namespace qwsm::dds
