// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/mcap_writer.hpp"

#include <algorithm>
#include <functional>

#include "service/io/bags/containers/chunk_codec.hpp"
#include "service/io/bags/containers/mcap_format.hpp"
#include "service/io/bags/writing/message_definitions.hpp"
#include "service/io/files/binary.hpp"

namespace qwsm::io {
namespace {

using std::literals::operator""sv;

constexpr std::size_t kFullChunkBytes = 768 * 1024;  // As rosbag2 has it.

using Pairs = std::vector<std::pair<std::string, std::string>>;

void AddPairs(BinaryWriter& record, const Pairs& pairs) {
  BinaryWriter entries;
  for (const auto& [key, value] : pairs) {
    entries.Add(std::string_view(key));
    entries.Add(std::string_view(value));
  }
  record.Add(std::string_view(entries.bytes()));
}

std::string RecordOf(std::uint8_t opcode, std::string_view body) {
  BinaryWriter record;
  record.Add(opcode);
  record.Add(static_cast<std::uint64_t>(body.size()));
  record.AddBytes(body);
  return record.bytes();
}

std::uint16_t IdOf(std::size_t topic) { return static_cast<std::uint16_t>(topic + 1); }

}  // namespace

McapWriter::McapWriter(std::ostream& stream) : stream_(&stream) {
  *stream_ << mcap::kMagic;
  offset_ = mcap::kMagic.size();
  BinaryWriter header;
  header.Add("ros2"sv);
  header.Add("qwsm"sv);
  Append(mcap::kHeader, header.bytes());
}

void McapWriter::Append(std::uint8_t opcode, std::string_view body) {
  const std::string record = RecordOf(opcode, body);
  *stream_ << record;
  offset_ += record.size();
}

std::size_t McapWriter::AddTopic(const TopicToWrite& topic) {
  summary_.topics.push_back({.topic = topic, .messages = 0});
  const std::size_t number = summary_.topics.size() - 1;
  chunk_ += RecordOf(mcap::kSchema, SchemaRecord(number));
  chunk_ += RecordOf(mcap::kChannel, ChannelRecord(number));
  return number;
}

std::string McapWriter::SchemaRecord(std::size_t topic) const {
  const std::string& type = summary_.topics[topic].topic.type;
  BinaryWriter record;
  record.Add(IdOf(topic));
  record.Add(std::string_view(type));
  record.Add("ros2msg"sv);
  record.Add(std::string_view(MessageDefinition(type)));
  return record.bytes();
}

std::string McapWriter::ChannelRecord(std::size_t topic) const {
  const TopicToWrite& written = summary_.topics[topic].topic;
  BinaryWriter record;
  record.Add(IdOf(topic));
  record.Add(IdOf(topic));
  record.Add(std::string_view(written.name));
  record.Add("cdr"sv);
  AddPairs(record,
           {{"offered_qos_profiles", QosOf(written)},
            {"topic_type_hash", std::string(TypeHash(written.type))}});
  return record.bytes();
}

void McapWriter::Write(std::size_t topic, Timestamp stamp, std::string_view cdr) {
  const auto time = static_cast<std::uint64_t>(stamp.count());
  const bool is_first = places_.empty();
  chunk_first_ = is_first ? time : std::min(chunk_first_, time);
  chunk_last_ = is_first ? time : std::max(chunk_last_, time);
  places_[IdOf(topic)].emplace_back(time, chunk_.size());
  BinaryWriter record;
  record.Add(IdOf(topic));
  record.Add(static_cast<std::uint32_t>(summary_.topics[topic].messages));
  record.Add(time);  // Logged and published.
  record.Add(time);
  record.AddBytes(cdr);
  chunk_ += RecordOf(mcap::kMessage, record.bytes());
  summary_.Count(topic, stamp);
  if (chunk_.size() >= kFullChunkBytes) EndChunk();
}

void McapWriter::EndChunk() {
  const std::string packed = CompressZstd(chunk_);
  BinaryWriter record;
  record.Add(chunk_first_);
  record.Add(chunk_last_);
  record.Add(static_cast<std::uint64_t>(chunk_.size()));
  record.Add(Checksum(chunk_));
  record.Add("zstd"sv);
  record.Add(static_cast<std::uint64_t>(packed.size()));
  record.AddBytes(packed);
  ChunkIndex index;
  index.first = chunk_first_;
  index.last = chunk_last_;
  index.offset = offset_;
  index.packed_size = packed.size();
  index.plain_size = chunk_.size();
  Append(mcap::kChunk, record.bytes());
  index.size = offset_ - index.offset;
  AppendIndexes(index);
  chunks_.push_back(index);
  chunk_.clear();
  places_.clear();
}

void McapWriter::AppendIndexes(ChunkIndex& chunk) {
  const std::uint64_t begin = offset_;
  for (auto& [topic, places] : places_) {
    std::ranges::stable_sort(places, {}, &std::pair<std::uint64_t, std::uint64_t>::first);
    BinaryWriter entries;
    for (const auto& [time, offset] : places) {
      entries.Add(time);
      entries.Add(offset);
    }
    BinaryWriter record;
    record.Add(topic);
    record.Add(std::string_view(entries.bytes()));
    chunk.index_offsets[topic] = offset_;
    Append(mcap::kMessageIndex, record.bytes());
  }
  chunk.indexes_size = offset_ - begin;
}

void McapWriter::Finish(const std::string& file_name) {
  if (!chunk_.empty()) EndChunk();
  const std::uint64_t metadata_offset = offset_;
  BinaryWriter metadata;
  metadata.Add("rosbag2"sv);
  AddPairs(metadata, {{"serialized_metadata", MetadataYaml(summary_, storage(), file_name)}});
  Append(mcap::kMetadata, metadata.bytes());
  const std::uint64_t metadata_size = offset_ - metadata_offset;
  BinaryWriter end;
  end.Add(std::uint32_t{0});  // No checksum: the chunks have their own.
  Append(mcap::kDataEnd, end.bytes());
  AppendSummary(metadata_offset, metadata_size);
  *stream_ << mcap::kMagic;
}

void McapWriter::AppendSummary(std::uint64_t metadata_offset, std::uint64_t metadata_size) {
  const std::uint64_t begin = offset_;
  BinaryWriter offsets;
  const auto add_group = [&](std::uint8_t opcode, const std::function<void()>& append_all) {
    const std::uint64_t group = offset_;
    append_all();
    if (offset_ == group) return;
    BinaryWriter record;
    record.Add(opcode);
    record.Add(group);
    record.Add(offset_ - group);
    offsets.AddBytes(RecordOf(mcap::kSummaryOffset, record.bytes()));
  };
  const std::size_t topics = summary_.topics.size();
  add_group(mcap::kSchema, [&] {
    for (std::size_t i = 0; i < topics; ++i) Append(mcap::kSchema, SchemaRecord(i));
  });
  add_group(mcap::kChannel, [&] {
    for (std::size_t i = 0; i < topics; ++i) Append(mcap::kChannel, ChannelRecord(i));
  });
  add_group(mcap::kStatistics, [&] { Append(mcap::kStatistics, StatisticsRecord()); });
  add_group(mcap::kChunkIndex, [&] {
    for (const ChunkIndex& chunk : chunks_) Append(mcap::kChunkIndex, ChunkIndexRecord(chunk));
  });
  add_group(mcap::kMetadataIndex, [&] {
    BinaryWriter record;
    record.Add(metadata_offset);
    record.Add(metadata_size);
    record.Add("rosbag2"sv);
    Append(mcap::kMetadataIndex, record.bytes());
  });
  BinaryWriter footer;
  footer.Add(begin);
  footer.Add(offset_);
  footer.Add(std::uint32_t{0});
  *stream_ << offsets.bytes();
  Append(mcap::kFooter, footer.bytes());
}

std::string McapWriter::StatisticsRecord() const {
  BinaryWriter counts;
  for (std::size_t i = 0; i < summary_.topics.size(); ++i) {
    counts.Add(IdOf(i));
    counts.Add(summary_.topics[i].messages);
  }
  BinaryWriter record;
  record.Add(summary_.messages);
  record.Add(static_cast<std::uint16_t>(summary_.topics.size()));  // Schemas.
  record.Add(static_cast<std::uint32_t>(summary_.topics.size()));  // Channels.
  record.Add(std::uint32_t{0});                                    // Attachments.
  record.Add(std::uint32_t{1});                                    // Metadata.
  record.Add(static_cast<std::uint32_t>(chunks_.size()));
  record.Add(static_cast<std::uint64_t>(summary_.first.count()));
  record.Add(static_cast<std::uint64_t>(summary_.last.count()));
  record.Add(std::string_view(counts.bytes()));
  return record.bytes();
}

std::string McapWriter::ChunkIndexRecord(const ChunkIndex& chunk) {
  BinaryWriter offsets;
  for (const auto& [topic, offset] : chunk.index_offsets) {
    offsets.Add(topic);
    offsets.Add(offset);
  }
  BinaryWriter record;
  record.Add(chunk.first);
  record.Add(chunk.last);
  record.Add(chunk.offset);
  record.Add(chunk.size);
  record.Add(std::string_view(offsets.bytes()));
  record.Add(chunk.indexes_size);
  record.Add("zstd"sv);
  record.Add(chunk.packed_size);
  record.Add(chunk.plain_size);
  return record.bytes();
}

}  // namespace qwsm::io
