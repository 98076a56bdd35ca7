// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/topic_feed.hpp"

#include <optional>
#include <utility>

namespace qwsm::dds {
namespace {

// What is not ours could be without bound: who publishes more topics is no team but an attack.
constexpr std::size_t kMostHeardTopics = 2048;

}  // namespace

TopicFeed::TopicFeed(const Participant& participant, Listener listener)
    : participant_(participant),
      listener_(std::move(listener)),
      wait_set_(participant),
      publications_(participant) {
  wait_set_.Add(publications_.handle());
}

void TopicFeed::Deliver(std::chrono::nanoseconds timeout) {
  wait_set_.Wait(timeout);
  publications_.TakeAll([this](const Publication& publication) {
    if (publication.is_alive) Note(publication);
  });
  for (const auto& [name, heard] : heard_) TakeFrom(heard);
}

Profile TopicFeed::ProfileOf(const Terms& terms) {
  if (!terms.is_reliable) return Profile::kRecorded;
  return terms.is_latched ? Profile::kRecordedLatched : Profile::kRecordedWhole;
}

/// Listens to a topic when its first writer appears, and with weaker terms when a writer offers
/// less than those before.
void TopicFeed::Note(const Publication& publication) {
  const std::optional<std::string> name = RosTopicOf(publication.topic);
  if (!name || passed_over_.contains(*name)) return;
  const TopicType* const type = FindTopicType(publication.type);
  const Terms terms{publication.is_reliable, publication.is_latched};
  if (const auto known = heard_.find(*name); known != heard_.end()) {
    if (type == known->second.type) Weaken(known->second, terms);
    return;
  }
  if (heard_.size() + passed_over_.size() >= kMostHeardTopics) return;
  if (!listener_.wants(*name)) {
    passed_over_.insert(*name);
    return;
  }
  const PublishedTopic told{
      .name = *name, .type = RosTypeOf(publication.type), .is_latched = publication.is_latched};
  if (type == nullptr) {
    PassOver(told, "messages of this type are not known here");
  } else {
    Listen(told, *type, terms);
  }
}

void TopicFeed::Weaken(const Heard& heard, const Terms& terms) {
  const Terms weakest{.is_reliable = terms.is_reliable && heard.terms.is_reliable,
                      .is_latched = terms.is_latched && heard.terms.is_latched};
  if (weakest == heard.terms) return;
  TakeFrom(heard);
  const PublishedTopic told = heard.told;
  const TopicType& type = *heard.type;
  wait_set_.Remove(heard.reader.handle());
  heard_.erase(told.name);
  Listen(told, type, weakest);
}

void TopicFeed::Listen(const PublishedTopic& told, const TopicType& type, const Terms& terms) {
  try {
    RawReader reader(participant_, *type.descriptor, told.name, ProfileOf(terms));
    wait_set_.Add(reader.handle());
    heard_.emplace(told.name, Heard{told, &type, terms, std::move(reader)});
  } catch (const DdsError& error) {
    PassOver(told, error.what());
  }
}

void TopicFeed::PassOver(const PublishedTopic& topic, const std::string& why) {
  passed_over_.insert(topic.name);
  listener_.pass_over(topic, why);
}

void TopicFeed::TakeFrom(const Heard& heard) const {
  heard.reader.TakeAll([&](const RawSample& sample) { listener_.take(heard.told, sample); });
}

}  // namespace qwsm::dds
