// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "service/io/bags/writing/bag_writer.hpp"

namespace qwsm::io {

/// Writes MCAP (mcap.dev/spec) as rosbag2 does: chunks packed with zstd, each with an index, and a
/// summary at the end.
class McapWriter final : public BagWriter {
 public:
  /// Begins a file. The stream outlives this; whether it took everything is its own to say.
  explicit McapWriter(std::ostream& stream);

  std::string_view storage() const override { return "mcap"; }
  std::size_t AddTopic(const TopicToWrite& topic) override;
  void Write(std::size_t topic, Timestamp stamp, std::string_view cdr) override;
  void Finish(const std::string& file_name) override;

 private:
  /// Where the messages of a topic stand in the chunk, with their times.
  using Places = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  struct ChunkIndex {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
    std::uint64_t indexes_size = 0;
    std::uint64_t packed_size = 0;
    std::uint64_t plain_size = 0;
  };

  void Append(std::uint8_t opcode, std::string_view body);
  void EndChunk();
  void AppendIndexes(ChunkIndex& chunk);
  void AppendSummary(std::uint64_t metadata_offset, std::uint64_t metadata_size);
  std::string SchemaRecord(std::size_t topic) const;
  std::string ChannelRecord(std::size_t topic) const;
  std::string StatisticsRecord() const;
  static std::string ChunkIndexRecord(const ChunkIndex& chunk);

  std::ostream* stream_;
  std::uint64_t offset_ = 0;  // Bytes written so far.
  std::string chunk_;         // Its records, as they are.
  std::uint64_t chunk_first_ = 0;
  std::uint64_t chunk_last_ = 0;
  std::map<std::uint16_t, Places> places_;
  std::vector<ChunkIndex> chunks_;
};

}  // namespace qwsm::io
