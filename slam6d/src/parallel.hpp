// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace slam6d {

/// Calls `work(chunk, first, last)` for the fixed pieces [first, last) of [0, count), from as many
/// threads as asked for. Which thread takes which piece is left open: work that writes only to what
/// belongs to its piece, and is summed over the pieces in their order, gives the same bits for any
/// number of threads. `work` must not throw.
template <class Work>
void ForChunks(std::size_t count, std::size_t chunk_size, int threads, const Work& work) {
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
      work(chunk, chunk * chunk_size, std::min(count, (chunk + 1) * chunk_size));
    }
  };
  std::vector<std::jthread> helpers;
  for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(std::max(threads, 1)), chunks);
       ++i) {
    helpers.emplace_back(run);
  }
  run();
}

}  // namespace slam6d
