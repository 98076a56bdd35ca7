// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>

namespace qwsm::io {

/// The chunks of a bag that were used last, undone of their compression: messages that are read
/// again in the order of time come from one chunk, or a few in turns. Of large chunks, fewer are
/// kept.
class ChunkCache {
 public:
  using Load = std::function<std::string(std::uint64_t offset)>;

  /// Starts empty. @param load undoes the compression of the chunk at an offset of the file.
  explicit ChunkCache(Load load) : load_(std::move(load)) {}

  /// The plain bytes of the chunk at `offset`; valid until the next call.
  const std::string& At(std::uint64_t offset) {
    for (const auto& [known, bytes] : chunks_) {
      if (known == offset) return bytes;
    }
    while (chunks_.size() >= kKept || (bytes_ > kMostBytes && !chunks_.empty())) {
      bytes_ -= chunks_.front().second.size();
      chunks_.pop_front();
    }
    const std::string& loaded = chunks_.emplace_back(offset, load_(offset)).second;
    bytes_ += loaded.size();
    return loaded;
  }

 private:
  static constexpr std::size_t kKept = 4;
  // Of those kept beside a new one.
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20;

  Load load_;
  std::size_t bytes_ = 0;
  std::deque<std::pair<std::uint64_t, std::string>> chunks_;
};

}  // namespace qwsm::io
