// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/writer.hpp"

#include <dds/dds.h>

#include "service/dds/entities/topic.hpp"

namespace qwsm::dds {

UntypedWriter::UntypedWriter(const Participant& participant,
                             const dds_topic_descriptor_t& descriptor,
                             const std::string& topic,
                             Profile profile,
                             const std::string& user_data) {
  const Qos qos = QosOf(profile);
  if (!user_data.empty()) dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  topic_ = MakeTopic(participant, descriptor, topic);
  writer_ = Entity(dds_create_writer(participant.handle(), topic_.handle(), qos.get(), nullptr),
                   topic + ": cannot be written");
}

std::size_t UntypedWriter::reader_count() const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(handle(), &status);
  return status.current_count;
}

bool UntypedWriter::WriteSample(const void* sample) const {
  return dds_write(handle(), sample) == DDS_RETCODE_OK;
}

}  // namespace qwsm::dds
