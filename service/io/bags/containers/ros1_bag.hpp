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

/// Reads bags of ROS 1, format 2.0 (wiki.ros.org/Bags/Format/2.0), record after record: of the
/// index at their end only the topics are taken, and those stand before their messages, too; so a
/// bag that was never closed, or cut off, is read the same way.
class Ros1Bag final : public ChunkedBag {
 public:
  /// Opens a file that begins as bags do.
  /// @throws std::runtime_error where it cannot be opened, or is of an older format.
  Ros1Bag(const std::filesystem::path& path, TellDamage tell);

  static bool Recognizes(std::string_view first_bytes);

  std::string_view format() const override { return "ROS 1 bag"; }
  std::string_view Read(const MessageAddress& address) override;

 private:
  /// A record as it stands: fields, then contents.
  struct Record {
    std::string_view header;
    std::string_view body;
    std::uint64_t size = 0;  ///< Of the whole record, as it claims.
  };

  std::optional<BagMessage> NextInChunk() override;
  std::optional<BagMessage> NextInFile() override;
  std::optional<BagMessage> Take(const Record& record, const MessageAddress& address);
  void TakeConnection(const Record& record);
  void ReadIndex();
  std::string LoadChunk(std::uint64_t offset) override;
  std::optional<Record> RecordAt(std::uint64_t offset);
  std::optional<std::uint64_t> FindChunk(std::uint64_t from) override;

  std::map<std::uint32_t, std::size_t> connections_;  // Index of the topic.
};

}  // namespace qwsm::io
