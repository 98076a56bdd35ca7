// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "service/io/bags/containers/chunked_bag.hpp"

namespace qwsm::io {

/// Reads MCAP files (mcap.dev/spec), record after record: of the summary at their end only the
/// topics are taken, and those stand before their messages, too; so a file without one, or cut off,
/// is read the same way.
class McapFile final : public ChunkedBag {
 public:
  /// Opens a file that begins as MCAP does. @throws std::runtime_error where it cannot be opened.
  McapFile(const std::filesystem::path& path, TellDamage tell);

  static bool Recognizes(std::string_view first_bytes);

  std::string_view format() const override { return "rosbag2 (mcap)"; }
  std::string_view Read(const MessageAddress& address) override;

 private:
  struct Record {
    std::uint8_t opcode = 0;
    std::string_view body;
  };

  std::optional<BagMessage> NextInChunk() override;
  std::optional<BagMessage> NextInFile() override;
  std::optional<BagMessage> Take(const Record& record, const MessageAddress& address);
  void ReadSummary();
  void TakeSchema(std::string_view body);
  void TakeChannel(std::string_view body);
  std::optional<BagMessage> TakeMessage(std::string_view body, const MessageAddress& address);
  std::string LoadChunk(std::uint64_t offset) override;
  bool IsChunk(std::uint64_t offset, std::string_view start) const;
  std::optional<std::uint64_t> FindChunk(std::uint64_t from) override;

  std::map<std::uint16_t, std::string> types_;                    // By schema.
  std::map<std::uint16_t, std::optional<std::size_t>> channels_;  // Index of the topic.
};

}  // namespace qwsm::io
