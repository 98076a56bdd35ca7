// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "service/dds/entities/participant.hpp"
#include "service/dds/entities/profile.hpp"
#include "service/dds/entities/wire_types.hpp"

namespace qwsm::dds {

/// The part of a reader that does not depend on its type.
class UntypedReader {
 public:
  /// Subscribes to a topic.
  /// @param topic name as ROS has it, such as `/robot1/scan`.
  /// @throws DdsError.
  UntypedReader(const Participant& participant,
                const dds_topic_descriptor_t& descriptor,
                const std::string& topic,
                Profile profile);

  /// How many writers there are now that this reader hears.
  std::size_t writer_count() const;
  /// How many writers that this reader heard are gone.
  std::size_t lost_writer_count() const;
  /// How many writers of its topic this reader could not hear, as they offer less than it needs.
  std::size_t unheard_writer_count() const;
  /// The participants whose writers this reader hears now.
  std::set<Guid> Participants() const;
  Entity::Handle handle() const { return reader_.handle(); }

 protected:
  /// Hands over every sample that has arrived, in order, with its writer's handle, and gives it
  /// back to the middleware afterwards, whatever the callback does.
  /// @return how many samples there were.
  std::size_t TakeSamples(const std::function<void(const void*, std::uint64_t)>& take) const;
  /// The participant of a writer; all zeros where the writer is gone.
  Guid ParticipantOf(std::uint64_t writer) const;

 private:
  Entity topic_;
  Entity reader_;
};

/// Receives samples of one type from one topic.
template <class T>
class Reader : public UntypedReader {
 public:
  Reader(const Participant& participant, const std::string& topic, Profile profile)
      : UntypedReader(participant, *wire::kDescriptor<T>, topic, profile) {}

  /// Calls `take(const T&)` with every sample that has arrived; returns how many there were.
  template <class Take>
  std::size_t TakeAll(Take&& take) const {
    return TakeSamples(
        [&take](const void* sample, std::uint64_t) { take(*static_cast<const T*>(sample)); });
  }
  /// Calls `take(const T&, const Guid&)` with every sample that has arrived and the participant it
  /// comes from; returns how many there were.
  template <class Take>
  std::size_t TakeAllWithSource(Take&& take) const {
    return TakeSamples([this, &take](const void* sample, std::uint64_t writer) {
      take(*static_cast<const T*>(sample), ParticipantOf(writer));
    });
  }
};

}  // namespace qwsm::dds
