// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/chunked_bag.hpp"

#include <utility>

namespace qwsm::io {

ChunkedBag::ChunkedBag(const std::filesystem::path& path, TellDamage tell, std::uint64_t first)
    : file_(path),
      tell_(std::move(tell)),
      chunks_([this](std::uint64_t offset) { return LoadChunk(offset); }),
      next_(first) {}

std::optional<BagMessage> ChunkedBag::Next() {
  while (!ended_ || chunk_) {
    std::optional<BagMessage> message = chunk_ ? NextInChunk() : NextInFile();
    if (message) return message;
  }
  return std::nullopt;
}

void ChunkedBag::GoAround(std::uint64_t offset, const std::string& what) {
  tell_(offset, what);
  const std::optional<std::uint64_t> next = FindChunk(offset + 1);
  if (next) {
    next_ = *next;
  } else {
    ended_ = true;
  }
}

}  // namespace qwsm::io
