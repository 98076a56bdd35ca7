// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/team_inbox.hpp"

#include <utility>

#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/scan_conversion.hpp"

namespace qwsm::dds {

TeamInbox::TeamInbox(const Participant& participant,
                     const std::vector<std::string>& robots,
                     team::TeamService& service,
                     std::vector<RobotTopics*> topics,
                     Refusals& refusals)
    : service_(service),
      refusals_(refusals),
      shared_scans_(participant, kSharedScansTopic, Profile::kSharedScansOfOthers),
      epochs_(participant, RobotNames("").Topic(kMapEpochTopic), Profile::kSharedScansOfOthers),
      robots_(participant,
              robots,
              service.scan_topics(),
              service.robots(),
              std::move(topics),
              refusals) {
  robots_.wait_set().Add(shared_scans_.handle());
  robots_.wait_set().Add(epochs_.handle());
}

// What other services share comes first: a robot is looked for in all of the map.
void TeamInbox::Deliver(std::chrono::nanoseconds timeout) {
  robots_.Wait(timeout);
  DeliverSharedScans();
  DeliverEpochs();
  robots_.Deliver();
}

void TeamInbox::DeliverEpochs() {
  epochs_.TakeAll([&](const wire::MapEpoch& sample) {
    const std::string_view objection = ObjectionTo(sample);
    if (!objection.empty()) return refusals_.Add(std::string(kMapEpochTopic), objection);
    service_.TakeIn(FromWire(sample));
  });
}

// All that have come are handed over together: the service puts them in order.
void TeamInbox::DeliverSharedScans() {
  std::vector<team::TeamScan> scans;
  const std::size_t lost_services = shared_scans_.lost_writer_count();
  shared_scans_.TakeAll([&](const wire::RelevantScan& sample) {
    const std::string_view objection = ObjectionTo(sample);
    if (objection.empty()) {
      scans.push_back(FromWire(sample));
    } else {
      refusals_.Add(kSharedScansTopic, objection);
    }
  });
  if (!scans.empty()) service_.TakeIn(std::move(scans));
  if (lost_services > std::exchange(lost_services_, lost_services)) service_.OfferTakenIn();
}

}  // namespace qwsm::dds
