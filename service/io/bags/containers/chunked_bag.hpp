// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/io/bags/containers/chunk_cache.hpp"
#include "service/io/bags/containers/file_bytes.hpp"
#include "service/io/bags/containers/message_source.hpp"

namespace qwsm::io {

/// Reads a file of records, some of which are chunks: more records, compressed together. It is read
/// record after record, so that one that was never closed, or is cut off, is read the same way as
/// any other; behind damage it goes on at the next chunk.
class ChunkedBag : public MessageSource {
 public:
  const std::vector<BagTopic>& topics() const final { return topics_; }
  std::optional<BagMessage> Next() final;

 protected:
  struct Chunk {
    std::uint64_t offset = 0;  ///< Of its record in the file.
    std::size_t next = 0;      ///< Where its next record begins, in its plain bytes.
  };

  /// @param first where the first record begins.
  /// @throws std::runtime_error where the file cannot be opened.
  ChunkedBag(const std::filesystem::path& path, TellDamage tell, std::uint64_t first);

  /// The next message of the chunk that is being read, which is left at its end.
  virtual std::optional<BagMessage> NextInChunk() = 0;
  /// Takes the next record of the file: a message, a chunk to go on with, or something else.
  virtual std::optional<BagMessage> NextInFile() = 0;
  /// The plain bytes of a chunk, or as many as are good.
  virtual std::string LoadChunk(std::uint64_t offset) = 0;
  /// The first chunk that begins at `from` or behind.
  virtual std::optional<std::uint64_t> FindChunk(std::uint64_t from) = 0;

  /// Tells of damage, and goes on at the next chunk that can be told for one.
  void GoAround(std::uint64_t offset, const std::string& what);

  FileBytes file_;
  TellDamage tell_;
  ChunkCache chunks_;
  std::vector<BagTopic> topics_;
  std::uint64_t next_;  // Where the next record of the file begins.
  std::optional<Chunk> chunk_;
  bool ended_ = false;
};

}  // namespace qwsm::io
