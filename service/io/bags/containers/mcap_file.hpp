// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/io/bags/containers/chunk_cache.hpp"
#include "service/io/bags/containers/file_bytes.hpp"
#include "service/io/bags/containers/message_source.hpp"

namespace qwsm::io {

/// Reads MCAP files (mcap.dev/spec), record after record: of the summary at their end only the
/// topics are taken, and those stand before their messages, too; so a file without one, or cut off,
/// is read the same way.
class McapFile final : public MessageSource {
 public:
  /// Opens a file that begins as MCAP does. @throws std::runtime_error where it cannot be opened.
  McapFile(const std::filesystem::path& path, TellDamage tell);

  static bool Recognizes(std::string_view first_bytes);

  std::string_view format() const override { return "rosbag2 (mcap)"; }
  const std::vector<BagTopic>& topics() const override { return topics_; }
  std::optional<BagMessage> Next() override;
  std::string_view Read(const MessageAddress& address) override;

 private:
  struct Record {
    std::uint8_t opcode = 0;
    std::string_view body;
  };
  struct Chunk {
    std::uint64_t offset = 0;  ///< Of its record in the file.
    std::size_t next = 0;      ///< Where its next record begins, in its plain bytes.
  };

  std::optional<BagMessage> NextInChunk();
  std::optional<BagMessage> NextInFile();
  std::optional<BagMessage> Take(const Record& record, const MessageAddress& address);
  void ReadSummary();
  void TakeSchema(std::string_view body);
  void TakeChannel(std::string_view body);
  std::optional<BagMessage> TakeMessage(std::string_view body, const MessageAddress& address);
  std::string LoadChunk(std::uint64_t offset);
  void GoAround(std::uint64_t offset, const std::string& what);
  bool IsChunk(std::uint64_t offset, std::string_view start) const;
  std::optional<std::uint64_t> FindChunk(std::uint64_t from);

  FileBytes file_;
  TellDamage tell_;
  ChunkCache chunks_;
  std::vector<BagTopic> topics_;
  std::map<std::uint16_t, std::string> types_;                    // By schema.
  std::map<std::uint16_t, std::optional<std::size_t>> channels_;  // Index of the topic.
  std::uint64_t next_;  // Where the next record of the file begins.
  std::optional<Chunk> chunk_;
  bool ended_ = false;
};

}  // namespace qwsm::io
