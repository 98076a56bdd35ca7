// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/ros_graph.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {
namespace {

struct Endpoints {
  std::vector<Guid> readers;
  std::vector<Guid> writers;
};

std::vector<dds_entity_t> ChildrenOf(dds_entity_t entity) {
  const dds_return_t count = dds_get_children(entity, nullptr, 0);
  std::vector<dds_entity_t> children(count > 0 ? static_cast<std::size_t>(count) : 0);
  const dds_return_t got = dds_get_children(entity, children.data(), children.size());
  children.resize(std::min(children.size(), got > 0 ? static_cast<std::size_t>(got) : 0));
  return children;
}

/// Readers and writers are children of subscribers and publishers, which are the participant's.
Endpoints EndpointsOf(const Participant& participant) {
  Endpoints endpoints;
  for (const dds_entity_t group : ChildrenOf(participant.handle())) {
    for (const dds_entity_t endpoint : ChildrenOf(group)) {
      dds_guid_t guid{};
      if (dds_get_guid(endpoint, &guid) != DDS_RETCODE_OK) continue;
      const bool is_writer = dds_get_publisher(endpoint) > 0;
      (is_writer ? endpoints.writers : endpoints.readers).push_back(GuidOf(endpoint));
    }
  }
  return endpoints;
}

/// The announcement in one of its two forms: GIDs have 16 bytes, or 24.
template <class Info>
class Announcement {
 public:
  Announcement(const Participant& participant, const NetworkOptions& options) {
    const Endpoints endpoints = EndpointsOf(participant);
    readers_ = Pad(endpoints.readers);
    writers_ = Pad(endpoints.writers);
    info_.gid = Pad({participant.guid()}).front();
    std::strncpy(node_.node_namespace, "/", sizeof(node_.node_namespace) - 1);
    std::strncpy(node_.node_name, options.node.c_str(), sizeof(node_.node_name) - 1);
    Fill(node_.reader_gid_seq, readers_);
    Fill(node_.writer_gid_seq, writers_);
    info_.node_entities_info_seq._maximum = 1;
    info_.node_entities_info_seq._length = 1;
    info_.node_entities_info_seq._buffer = &node_;
  }
  Announcement(const Announcement&) = delete;
  Announcement& operator=(const Announcement&) = delete;

  const Info& info() const { return info_; }

 private:
  using Gid = decltype(Info::gid);
  using Node = std::remove_pointer_t<decltype(Info::node_entities_info_seq._buffer)>;

  static std::vector<Gid> Pad(const std::vector<Guid>& guids) {
    std::vector<Gid> gids(guids.size());
    for (std::size_t i = 0; i < guids.size(); ++i) std::ranges::copy(guids[i], gids[i].data);
    return gids;
  }
  template <class Sequence>
  static void Fill(Sequence& sequence, std::vector<Gid>& gids) {
    sequence._maximum = static_cast<std::uint32_t>(gids.size());
    sequence._length = sequence._maximum;
    sequence._buffer = gids.data();
  }

  std::vector<Gid> readers_;
  std::vector<Gid> writers_;
  Node node_{};
  Info info_{};
};

/// Both forms have the same names on the wire.
dds_topic_descriptor_t HumbleDescriptor() {
  dds_topic_descriptor_t descriptor = rmw_dds_common_msg_humble__ParticipantEntitiesInfo__desc;
  const char* name = rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc.m_typename;
  // The member is const, the copy is ours.
  std::memcpy(const_cast<char**>(&descriptor.m_typename), &name, sizeof(name));
  return descriptor;
}

class HumbleWriter : public UntypedWriter {
 public:
  HumbleWriter(const Participant& participant, const dds_topic_descriptor_t& descriptor)
      : UntypedWriter(participant, descriptor, kGraphTopic, Profile::kLatched) {}
  bool Write(const wire::HumbleParticipantEntitiesInfo& info) const { return WriteSample(&info); }
};

}  // namespace

class RosGraph::Topic {
 public:
  Topic(const Participant& participant, NetworkOptions options)
      : participant_(participant), options_(std::move(options)) {
    if (options_.humble) {
      humble_writer_.emplace(participant, humble_descriptor_);
    } else {
      writer_.emplace(participant, kGraphTopic, Profile::kLatched);
    }
  }

  void Announce() const {
    const std::lock_guard lock(mutex_);  // Of two announcements the later one is written last.
    if (writer_) {
      writer_->Write(Announcement<wire::ParticipantEntitiesInfo>(participant_, options_).info());
    } else {
      humble_writer_->Write(
          Announcement<wire::HumbleParticipantEntitiesInfo>(participant_, options_).info());
    }
  }

 private:
  const Participant& participant_;
  NetworkOptions options_;
  mutable std::mutex mutex_;
  dds_topic_descriptor_t humble_descriptor_ = HumbleDescriptor();
  std::optional<Writer<wire::ParticipantEntitiesInfo>> writer_;
  std::optional<HumbleWriter> humble_writer_;
};

RosGraph::RosGraph(const Participant& participant, NetworkOptions options)
    : topic_(std::make_unique<Topic>(participant, std::move(options))) {}

RosGraph::~RosGraph() = default;

void RosGraph::Announce() const { topic_->Announce(); }

}  // namespace qwsm::dds
