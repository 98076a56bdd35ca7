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

/// Reads bags of ROS 1, format 2.0 (wiki.ros.org/Bags/Format/2.0), record after record: of the
/// index at their end only the topics are taken, and those stand before their messages, too; so a
/// bag that was never closed, or cut off, is read the same way.
class Ros1Bag final : public MessageSource {
 public:
  /// Opens a file that begins as bags do.
  /// @throws std::runtime_error where it cannot be opened, or is of an older format.
  Ros1Bag(const std::filesystem::path& path, TellDamage tell);

  static bool Recognizes(std::string_view first_bytes);

  std::string_view format() const override { return "ROS 1 bag"; }
  const std::vector<BagTopic>& topics() const override { return topics_; }
  std::optional<BagMessage> Next() override;
  std::string_view Read(const MessageAddress& address) override;

 private:
  /// A record as it stands: fields, then contents.
  struct Record {
    std::string_view header;
    std::string_view body;
    std::uint64_t size = 0;  ///< Of the whole record, as it claims.
  };
  struct Chunk {
    std::uint64_t offset = 0;  ///< Of its record in the file.
    std::size_t next = 0;      ///< Where its next record begins, in its plain bytes.
  };

  std::optional<BagMessage> NextInChunk();
  std::optional<BagMessage> NextInFile();
  std::optional<BagMessage> Take(const Record& record, const MessageAddress& address);
  void TakeConnection(const Record& record);
  void ReadIndex();
  std::string LoadChunk(std::uint64_t offset);
  std::optional<Record> RecordAt(std::uint64_t offset);
  void GoAround(std::uint64_t offset, const std::string& what);
  std::optional<std::uint64_t> FindChunk(std::uint64_t from);

  FileBytes file_;
  TellDamage tell_;
  ChunkCache chunks_;
  std::vector<BagTopic> topics_;
  std::map<std::uint32_t, std::size_t> connections_;  // Index of the topic.
  std::uint64_t next_;                                // Where the next record of the file begins.
  std::optional<Chunk> chunk_;
  bool ended_ = false;
};

}  // namespace qwsm::io
