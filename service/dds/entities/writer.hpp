// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "service/dds/entities/participant.hpp"
#include "service/dds/entities/profile.hpp"
#include "service/dds/entities/wire_types.hpp"

namespace qwsm::dds {

/// The part of a writer that does not depend on its type.
class UntypedWriter {
 public:
  /// Publishes on a topic, told by its name as ROS has it, such as `/robot1/scan`.
  /// @param user_data what whoever discovers the writer is told of it. @throws DdsError.
  UntypedWriter(const Participant& participant,
                const dds_topic_descriptor_t& descriptor,
                const std::string& topic,
                Profile profile,
                const std::string& user_data = {});

  /// How many readers there are now that get what is written.
  std::size_t reader_count() const;
  Entity::Handle handle() const { return writer_.handle(); }

 protected:
  /// Hands a sample to the middleware; false where that was not possible in time. Safe to call from
  /// several threads.
  bool WriteSample(const void* sample) const;

 private:
  Entity topic_;
  Entity writer_;
};

/// Publishes samples of one type on one topic.
template <class T>
class Writer : public UntypedWriter {
 public:
  Writer(const Participant& participant,
         const std::string& topic,
         Profile profile,
         const std::string& user_data = {})
      : UntypedWriter(participant, *wire::kDescriptor<T>, topic, profile, user_data) {}

  /// Publishes a sample; false where that was not possible in time. The sample is copied; what it
  /// points to may be gone afterwards.
  bool Write(const T& sample) const { return WriteSample(&sample); }
};

}  // namespace qwsm::dds
