// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/reader.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <utility>

#include "service/dds/entities/topic.hpp"

namespace qwsm::dds {
namespace {

constexpr std::size_t kSampleBatch = 64;

/// Samples on loan from the middleware.
class Loan {
 public:
  explicit Loan(dds_entity_t reader)
      : reader_(reader),
        count_(dds_take(reader, samples_.data(), infos_.data(), kSampleBatch, kSampleBatch)) {}
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  ~Loan() {
    if (count_ > 0) dds_return_loan(reader_, samples_.data(), count_);
  }

  std::size_t count() const { return count_ > 0 ? static_cast<std::size_t>(count_) : 0; }
  /// Null where only the state of a writer changed.
  const void* operator[](std::size_t i) const {
    return infos_[i].valid_data ? samples_[i] : nullptr;
  }
  std::uint64_t WriterOf(std::size_t i) const { return infos_[i].publication_handle; }

 private:
  dds_entity_t reader_;
  std::array<void*, kSampleBatch> samples_{};
  std::array<dds_sample_info_t, kSampleBatch> infos_{};
  dds_return_t count_;
};

}  // namespace

UntypedReader::UntypedReader(const Participant& participant,
                             const dds_topic_descriptor_t& descriptor,
                             const std::string& topic,
                             Profile profile) {
  const Qos qos = QosOf(profile);
  topic_ = MakeTopic(participant, descriptor, topic);
  reader_ = Entity(dds_create_reader(participant.handle(), topic_.handle(), qos.get(), nullptr),
                   topic + ": cannot be read");
  dds_set_status_mask(handle(), DDS_DATA_AVAILABLE_STATUS);  // What a WaitSet wakes up for.
}

std::size_t UntypedReader::writer_count() const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(handle(), &status);
  return status.current_count;
}

std::size_t UntypedReader::unheard_writer_count() const {
  dds_requested_incompatible_qos_status_t status{};
  dds_get_requested_incompatible_qos_status(handle(), &status);
  return status.total_count;
}

std::size_t UntypedReader::lost_writer_count() const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(handle(), &status);
  return status.total_count - status.current_count;
}

std::set<Guid> UntypedReader::Participants() const {
  constexpr std::size_t kMostWriters = 1024;
  std::array<dds_instance_handle_t, kMostWriters> writers{};
  const dds_return_t count = dds_get_matched_publications(handle(), writers.data(), writers.size());
  std::set<Guid> participants;
  for (std::size_t i = 0; std::cmp_less(i, count) && i < writers.size(); ++i) {
    participants.insert(ParticipantOf(writers[i]));
  }
  return participants;
}

Guid UntypedReader::ParticipantOf(std::uint64_t writer) const {
  Guid guid{};
  dds_builtintopic_endpoint_t* const endpoint = dds_get_matched_publication_data(handle(), writer);
  if (endpoint == nullptr) return guid;
  std::ranges::copy(endpoint->participant_key.v, guid.begin());
  dds_builtintopic_free_endpoint(endpoint);
  return guid;
}

std::size_t UntypedReader::TakeSamples(
    const std::function<void(const void*, std::uint64_t)>& take) const {
  std::size_t taken = 0;
  while (true) {
    const Loan loan(handle());
    if (loan.count() == 0) return taken;
    for (std::size_t i = 0; i < loan.count(); ++i) {
      if (loan[i] == nullptr) continue;
      take(loan[i], loan.WriterOf(i));
      ++taken;
    }
  }
}

}  // namespace qwsm::dds
